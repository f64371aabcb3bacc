#include "tests/pipeline/formats/ball_images.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <vtkXMLImageDataWriter.h>
#include <zlib.h>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

// as gzip does
void pack(const std::filesystem::path& file, const std::string& bytes)
{
  gzFile out = gzopen(file.c_str(), "wb");
  ASSERT_EQ(gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size())), bytes.size());
  gzclose(out);
}

TEST_F(Images, NiftiStandsWhereItsHeaderSaysInAxesToLeftBackAndHead)
{
  // a quarter turn about the head's axis, and a shift, into right, front, head
  vtkNew<vtkMatrix4x4> form;
  const double values[16] = { 0, -1, 0, 7, 1, 0, 0, -9, 0, 0, 1, 11, 0, 0, 0, 1 };
  form->DeepCopy(values);
  const auto file = write<vtkNIFTIImageWriter>("ball.nii.gz", *ball(false), form);
  const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
  const Vector3d ras(-kCenterMm.y() + 7, kCenterMm.x() - 9, kCenterMm.z() + 11);
  EXPECT_LT(farthest(*surface.mesh, { -ras.x(), -ras.y(), ras.z() }), 0.2);
  EXPECT_GT(volumeMm3(*surface.mesh), 0.0); // turned outwards
}

// by hand, as the standard lays it out: 348 bytes, 4 of extension, voxels
std::string nifti(vtkImageData& image, float slope, float intercept, char unit, short volumes = 1)
{
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, const auto& value)
  { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, std::int32_t{ 348 });
  const int* size = image.GetDimensions();
  const std::array<short, 5> dim{ static_cast<short>(volumes > 1 ? 4 : 3),
    static_cast<short>(size[0]), static_cast<short>(size[1]), static_cast<short>(size[2]),
    volumes };
  put(40, dim);
  put(70, short{ 16 }); // float
  put(72, short{ 32 });
  std::array<float, 4> pixdim{ 1.0F };
  std::copy_n(image.GetSpacing(), 3, pixdim.begin() + 1);
  put(76, pixdim);
  put(108, 352.0F);
  put(112, slope);
  put(116, intercept);
  bytes[123] = unit;
  put(254, short{ 1 }); // sform
  for (std::size_t row = 0; row < 3; ++row)
  {
    put(280 + 20 * row, pixdim[row + 1]);
  }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  const auto count = static_cast<std::size_t>(image.GetNumberOfPoints());
  const std::string voxels(static_cast<const char*>(image.GetScalarPointer()), 4 * count);
  for (short i = 0; i < volumes; ++i)
  {
    bytes += voxels;
  }
  return bytes;
}

TEST_F(Images, NiftiValuesAreScaledAsTheHeaderSays)
{
  // the ball's surface, where the distance is 0, has the value 2 * 0 - 1000
  for (const float slope : { 2.0F, -2.0F })
  {
    const auto file = write("slope.nii", nifti(*ball(false), slope, -1000.0F, 2));
    const LoadedSurface surface = readSurface(file, {}, { -1000.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2);
    EXPECT_NE(refusal(file, { 5000.0, {} }).find("its values go from -"), std::string::npos);
  }
  // a slope of 0 means none
  const auto file = write("none.nii", nifti(*ball(false), 0.0F, 7.0F, 2));
  EXPECT_LT(farthest(*readSurface(file, {}, { 0.0, {} }).mesh,
              { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }),
    0.2);
}

// the first axis along the sum of the others, along none, not a number
TEST_F(Images, NiftiAxesThatDoNotSpanSpaceAreRefused)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::array<float, 3>& row :
    { std::array{ 0.0F, 2.5F, 3.0F }, { 0.0F, 0.0F, 0.0F }, { nan, 0.0F, 0.0F } })
  {
    std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
    std::memcpy(bytes.data() + 280, row.data(), sizeof row);
    const auto file = write("flat.nii", bytes);
    EXPECT_NE(refusal(file, { 0.0, {} }).find("do not span space"), std::string::npos);
  }
}

TEST_F(Images, NiftiUnitsAreTurnedIntoMillimeters)
{
  for (const auto& [code, size] : { std::pair('\1', 1e-3), { '\2', 1.0 }, { '\3', 1e3 } })
  {
    const auto image = ball(false);
    image->SetSpacing(2.0 * size, 2.5 * size, 3.0 * size);
    const auto file = write("unit.nii", nifti(*image, 1.0F, 0.0F, code));
    const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2)
      << int{ code };
  }
}

// as the other formats that name none: a ball of 60 mm may be one of 600 mm in cm
TEST_F(Images, NiftiWithoutAUnitIsAskedForIt)
{
  const auto image = ball(false);
  image->SetSpacing(1.0, 1.25, 1.5); // of half the size
  const auto file = write("none.nii", nifti(*image, 1.0F, 0.0F, 0));
  EXPECT_NE(refusal(file, { 0.0, {} }).find("more than one unit"), std::string::npos);
  EXPECT_NE(readSurface(file, LengthUnit::Millimeter, { 0.0, {} }).notes[0].find("mm, as asked"),
    std::string::npos);
}

TEST_F(Images, NiftiIsReadPackedOrNotWhateverItsName)
{
  const std::string plain = nifti(*ball(false), 1.0F, 0.0F, 2);
  const auto packed = write("packed.nii", "");
  pack(packed, plain);
  for (const auto& file : { packed, write("plain.nii.gz", plain) })
  {
    const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2);
  }
}

TEST_F(Images, NiftiWithMoreVoxelsThanItsHeaderClaimsIsRefusedWithBothSizes)
{
  std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
  const std::string claimed = std::to_string(bytes.size() - 352);
  bytes.append(100, '\0');
  const auto packed = write("more.nii.gz", "");
  pack(packed, bytes);
  for (const auto& file : { write("more.nii", bytes), packed })
  {
    const std::string message = refusal(file, { 0.0, {} });
    EXPECT_NE(message.find(std::to_string(bytes.size() - 352) + " bytes, more than the " + claimed),
      std::string::npos)
      << message;
  }
}

// neither alone, nor both: more voxels, and a checksum that is not theirs
TEST_F(Images, NiftiOfADamagedStreamIsRefusedWhateverItHolds)
{
  for (const std::size_t more : { 0U, 4U, 100U, 70'000U })
  {
    std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
    bytes.append(more, '\0');
    const auto file = write("damaged.nii.gz", "");
    pack(file, bytes);
    std::string packed = readAll(file);
    packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 0x10); // of the CRC
    const std::string message = refusal(write("damaged.nii.gz", packed), { 0.0, {} });
    EXPECT_NE(message.find("damaged"), std::string::npos) << more << ": " << message;
  }
}

// RFC 1952, 2.3: behind the data stand four bytes of a checksum and four of the length
TEST_F(Images, NiftiWithoutTheEndOfItsStreamIsCutOff)
{
  const std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
  const auto file = write("cut.nii.gz", "");
  pack(file, bytes);
  const std::string packed = readAll(file);
  for (const std::size_t less : { 1U, 4U, 7U, 8U, 9U, 100U })
  {
    const std::string message =
      refusal(write("cut.nii.gz", packed.substr(0, packed.size() - less)), { 0.0, {} });
    EXPECT_NE(message.find("cut off"), std::string::npos) << less << ": " << message;
  }
}

// its header is 540 bytes and says so first, as nifti2.h lays it out
TEST_F(Images, NiftiOfTheSecondVersionIsRefusedByName)
{
  std::string bytes(544 + 4 * 27, '\0');
  const std::int32_t size = 540;
  std::memcpy(bytes.data(), &size, sizeof size);
  std::memcpy(bytes.data() + 4, "n+2\0\r\n\032\n", 8);
  EXPECT_NE(refusal(write("second.nii", bytes), { 0.0, {} }).find("NIfTI-2"), std::string::npos);
}

// dim; pixdim, of which an sform needs no sign; datatypes as nifti1.h lists them
TEST_F(Images, NiftiHeadersAreRefusedByTheFieldThatIsWrong)
{
  const auto with = [&](std::size_t at, const auto& value, short sform)
  {
    std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
    std::memcpy(bytes.data() + 254, &sform, sizeof sform);
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return refusal(write("wrong.nii", bytes), { 0.0, {} });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const short sform : { short{ 0 }, short{ 1 } })
  {
    EXPECT_NE(with(80, 0.0F, sform).find("pixdim[1] is 0, no size"), std::string::npos);
    EXPECT_NE(with(84, nan, sform).find("pixdim[2] is nan, no size"), std::string::npos);
  }
  EXPECT_NE(with(44, short{ -48 }, 1).find("dim[2] is -48, no number"), std::string::npos);
  EXPECT_NE(with(88, -3.0F, 0).find("pixdim[3] is -3, no size"), std::string::npos);
  EXPECT_EQ(with(88, -3.0F, 1), "accepted");
  for (const float offset : { 0.0F, 348.0F, 352.5F, -1.0F, 1e30F, nan })
  {
    EXPECT_NE(with(108, offset, 1).find("its vox_offset is "), std::string::npos) << offset;
  }
  for (const auto& [type, words] : { std::pair(1, "single bits (datatype 1)"),
         { 1536, "16 bytes (datatype 1536)" }, { 128, "several values at each voxel" },
         { 2304, "several values at each voxel" }, { 3, "none of NIfTI's" } })
  {
    const std::string message = with(70, static_cast<short>(type), 1);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

// ITK prefers the qform where nibabel takes the sform
TEST_F(Images, NiftiWhoseTwoFormsDifferIsRefusedOrSaysSo)
{
  std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
  const auto put = [&](std::size_t at, const auto& value)
  { std::memcpy(bytes.data() + at, &value, sizeof value); };
  const auto notes = [&]
  {
    std::string all;
    for (const std::string& note : readSurface(write("two.nii", bytes), {}, { 0.0, {} }).notes)
    {
      all += note + '\n';
    }
    return all;
  };
  put(252, short{ 1 }); // a qform, at the same place
  EXPECT_EQ(notes().find("differently"), std::string::npos) << notes();
  put(268, 7.0F); // to the right [mm]
  EXPECT_NE(notes().find("qform and its sform place it differently"), std::string::npos) << notes();
  float side = 0.0F;
  std::memcpy(&side, bytes.data() + 280, sizeof side);
  put(280, 2.0F * side);
  const std::string message = refusal(write("two.nii", bytes), { 0.0, {} });
  EXPECT_NE(message.find("along axis 1; set the code of the wrong one to 0"), std::string::npos)
    << message;
}

// pixdim of 2 mm below an sform of 2.1: some programs measure by the one, some by the other
TEST_F(Images, NiftiWhosePixdimIsNotItsSformSaysSo)
{
  std::string bytes = nifti(*ball(false), 1.0F, 0.0F, 2);
  const auto all = [&](float side)
  {
    std::memcpy(bytes.data() + 80, &side, sizeof side);
    const LoadedSurface surface = readSurface(write("side.nii", bytes), {}, { 0.0, {} });
    EXPECT_LT(farthest(*surface.mesh, { -kCenterMm.x(), -kCenterMm.y(), kCenterMm.z() }), 0.2);
    return std::accumulate(surface.notes.begin(), surface.notes.end(), std::string());
  };
  EXPECT_EQ(all(2.0F).find("pixdim"), std::string::npos);
  EXPECT_EQ(all(2.015F).find("pixdim"), std::string::npos);
  const std::string told = all(2.1F);
  EXPECT_NE(told.find("warning: side.nii: its pixdim has voxels of 2.1 and its sform of 2 along "
                      "axis 1; the sform is taken"),
    std::string::npos)
    << told;
}

TEST_F(Images, RefusesASeriesOverTimeWithTheWayOut)
{
  const std::string message =
    refusal(write("four.nii", nifti(*ball(false), 1.0F, 0.0F, 2, 3)), { 0.0, {} });
  EXPECT_NE(message.find("a series of 3 volumes"), std::string::npos) << message;
  EXPECT_NE(message.find("save one of them"), std::string::npos) << message;
}

TEST_F(Images, SaysTheFrame)
{
  const auto file = write("one.nii", nifti(*ball(false), 1.0F, 0.0F, 2));
  const LoadedSurface surface = readSurface(file, {}, { 0.0, {} });
  std::string all;
  for (const std::string& note : surface.notes)
  {
    all += note + '\n';
  }
  EXPECT_NE(all.find("(LPS), turned from NIfTI's"), std::string::npos) << all;
}

TEST_F(Images, ADamagedImageIsRefusedInOneSentence)
{
  const auto image = ball(true);
  for (const auto& whole :
    { write<vtkMetaImageWriter>("a.mha", *image), write<vtkNIFTIImageWriter>("a.nii", *image),
      write<vtkNIFTIImageWriter>("a.nii.gz", *image),
      write<vtkXMLImageDataWriter>("a.vti", *image) })
  {
    const std::string bytes = readAll(whole);
    for (const double part : { 0.01, 0.3, 0.9 })
    {
      const std::filesystem::path cut = folder_.path() / ("cut_" + whole.filename().string());
      std::ofstream(cut, std::ios::binary)
        << bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
      const std::string message = refusal(cut, { 0.5, {} });
      EXPECT_NE(message, "accepted") << cut << ' ' << part;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

} // namespace
} // namespace palp::test

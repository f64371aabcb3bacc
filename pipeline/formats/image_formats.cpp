#include "pipeline/formats/image_formats.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/images/meta_image.h"
#include "pipeline/formats/images/nifti_header.h"
#include "pipeline/formats/images/nrrd_image.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/vtk_formats.h"
#include "pipeline/process/file_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>

namespace palp
{
namespace
{

constexpr std::array kIdentity{ 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
  0.0, 0.0, 1.0 };

constexpr const char* kPatientAxes = "in the patient's axes to left, back and head (LPS)";

[[noreturn]] void refuseTurned(const std::filesystem::path& file)
{
  refuse(file, "its axes are turned, which is read from NIfTI only; save it as .nii.gz");
}

PatientImage straight(vtkSmartPointer<vtkImageData> image)
{
  PatientImage result{ .image = std::move(image), .toPatient = {} };
  std::copy(kIdentity.begin(), kIdentity.end(), result.toPatient);
  return result;
}

// NIfTI's factor from its unit to mm; 0: it names none
double niftiUnit(int code)
{
  constexpr int spatial = 7; // the other bits are of time
  switch (code & spatial)
  {
    case 1:
      return 1e3; // m
    case 2:
      return 1.0;
    case 3:
      return 1e-3; // um
    default:
      return 0.0;
  }
}

// voxels' cells in extents: each after a key, as Extent="0 9 0 9 0 9"
std::uintmax_t cellsIn(std::string_view text, std::string_view key)
{
  std::uintmax_t cells = 0;
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1))
  {
    std::istringstream words(std::string(text.substr(at + key.size(), 100)));
    words.ignore(2, '"');
    std::uintmax_t product = 1;
    std::int64_t low = 0;
    std::int64_t high = 0;
    for (int axis = 0; axis < 3 && words >> low >> high; ++axis)
    {
      product *= high > low ? static_cast<std::uintmax_t>(high - low) : 0;
    }
    cells += product;
  }
  return cells;
}

// VTK takes its own place, size and direction for those that it cannot read
void checkNumbers(const std::filesystem::path& file, std::string_view text)
{
  const std::size_t tag = std::min(text.find("<ImageData"), text.size());
  text = text.substr(tag, text.find('>', tag) - tag);
  for (const auto& [key, count] : { std::pair("Origin", 3), { "Spacing", 3 }, { "Direction", 9 } })
  {
    const std::size_t at = text.find(key + std::string("=\""));
    if (at == text.npos)
    {
      continue;
    }
    const std::size_t begin = text.find('"', at) + 1;
    std::istringstream words(std::string(text.substr(begin, text.find('"', begin) - begin)));
    int got = 0;
    for (double number = 0.0; words >> number;)
    {
      ++got;
    }
    if (got != count || !words.eof())
    {
      refuse(file,
        std::string("its ") + key + " is not " + std::to_string(count) +
          " numbers; export it again");
    }
  }
}

// and leaves voxels that no piece has as they come
void checkVtiHeader(const std::filesystem::path& file)
{
  const std::string text = checkedXml(file);
  checkNumbers(file, text);
  if (cellsIn(text, "<Piece Extent=") != cellsIn(text, "WholeExtent="))
  {
    refuse(file, "damaged, its pieces do not fill its WholeExtent; export it again");
  }
}

// of WholeExtent="0 9 0 9 0 9", with the largest number that a voxel may be
std::uintmax_t vtiBytes(const std::filesystem::path& file)
{
  std::string start(4096, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(4096));
  const std::string key = "WholeExtent=\"";
  const std::size_t at = start.find(key);
  std::istringstream words(at == start.npos ? "" : start.substr(at + key.size(), 200));
  std::uintmax_t bytes = sizeof(double);
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(words >> low >> high) || high < low || high - low > 100'000)
    {
      return 0;
    }
    bytes *= static_cast<std::uintmax_t>(high - low + 1);
  }
  return bytes;
}

} // namespace

PatientImage readMetaImage(const std::filesystem::path& file)
{
  const MetaHeader header = readMetaHeader(file);
  PatientImage result = straight(readMetaVolume(file, header));
  result.slope = header.slope;
  result.intercept = header.intercept;
  result.unit = header.unit.empty() ? "" : "mm";
  const double factor = header.unit == "um" ? 1e-3 : header.unit == "cm" ? 10.0 : 1.0;
  for (int i = 0; i < 12; ++i)
  {
    result.toPatient[i] *= factor;
  }
  result.notes.emplace_back(kPatientAxes);
  return result;
}

// programs differ in which of the two forms they take: of another size one of them is wrong
void compareForms(
  const std::filesystem::path& file, vtkNIFTIImageReader& reader, std::vector<std::string>& notes)
{
  vtkMatrix4x4& rigid = *reader.GetQFormMatrix(); // of the sides that pixdim tells
  vtkMatrix4x4& affine = *reader.GetSFormMatrix();
  constexpr double kAlike = 0.01;
  for (int k = 0; k < 3; ++k)
  {
    const double growth =
      std::hypot(affine.GetElement(0, k), affine.GetElement(1, k), affine.GetElement(2, k));
    if (std::abs(growth - 1.0) > kAlike)
    {
      const double side = reader.GetOutput()->GetSpacing()[k];
      std::ostringstream words;
      words << "its qform has voxels of " << side << " and its sform of " << side * growth
            << " along axis " << k + 1 << "; set the code of the wrong one to 0";
      refuse(file, words.str());
    }
  }
  const double* bounds = reader.GetOutput()->GetBounds();
  for (int corner = 0; corner < 8; ++corner)
  {
    const double at[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
      bounds[4 + (corner >> 2)], 1.0 };
    double one[4];
    double other[4];
    rigid.MultiplyPoint(at, one);
    affine.MultiplyPoint(at, other);
    if (std::sqrt(vtkMath::Distance2BetweenPoints(one, other)) >
      0.5 * *reader.GetOutput()->GetSpacing())
    {
      notes.emplace_back(
        "warning: its qform and its sform place it differently; the sform is taken");
      return;
    }
  }
}

// the better of the two forms a header may have; both lead to right, front, head
void placeInPatient(
  const std::filesystem::path& file, vtkNIFTIImageReader& reader, PatientImage& image)
{
  if (reader.GetSFormMatrix() && reader.GetQFormMatrix())
  {
    compareForms(file, reader, image.notes);
  }
  vtkMatrix4x4* form = reader.GetSFormMatrix() ? reader.GetSFormMatrix() : reader.GetQFormMatrix();
  if (form)
  {
    std::copy_n(form->GetData(), 16, image.toPatient);
    for (int i = 0; i < 8; ++i) // x and y
    {
      image.toPatient[i] = -image.toPatient[i];
    }
  }
  image.notes.emplace_back(form
      ? std::string(kPatientAxes) + ", turned from NIfTI's to right, front and head (RAS)"
      : "the header tells no place in the patient; axes and corner of the voxels are taken");
}

// into mm, where it names a unit; only the first volume was read
void applyUnit(vtkNIFTIImageHeader& header, PatientImage& image)
{
  const double factor = niftiUnit(header.GetXYZTUnits());
  for (int i = 0; i < 12; ++i)
  {
    image.toPatient[i] *= factor > 0.0 ? factor : 1.0;
  }
  image.unit = factor > 0.0 ? "mm" : "";
  if (header.GetDim(0) > 3 && header.GetDim(4) > 1)
  {
    image.notes.emplace_back(
      "warning: the first of " + std::to_string(header.GetDim(4)) + " volumes is taken");
  }
}

PatientImage readNifti(const std::filesystem::path& file)
{
  checkNiftiLength(file, readNiftiHeader(file));
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  PatientImage result = straight(reader->GetOutput());
  placeInPatient(file, *reader, result);
  result.slope = reader->GetRescaleSlope();
  result.intercept = reader->GetRescaleIntercept();
  if (!std::isfinite(result.slope) || !std::isfinite(result.intercept))
  {
    refuse(file, "scl_slope or scl_inter is not a number; export it again");
  }
  if (result.slope == 0.0) // values as they are stored
  {
    result.slope = 1.0;
    result.intercept = 0.0;
  }
  if (vtkNIFTIImageHeader* header = reader->GetNIFTIHeader())
  {
    applyUnit(*header, result);
  }
  return result;
}

namespace
{

// the one array of numbers at the points, where none is marked as the scalars
void findScalars(const std::filesystem::path& file, vtkImageData& image)
{
  vtkPointData& points = *image.GetPointData();
  if (points.GetScalars())
  {
    return;
  }
  std::vector<std::string> names;
  for (int i = 0; i < points.GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = points.GetArray(i))
    {
      names.emplace_back(array->GetName() ? array->GetName() : "");
    }
  }
  if (names.empty())
  {
    refuse(file,
      image.GetCellData()->GetNumberOfArrays() > 0
        ? "its values are those of cells, not of points; save them as point data"
        : "no values at its points; export it again");
  }
  if (names.size() > 1)
  {
    refuse(file,
      std::to_string(names.size()) + " arrays at its points, as " + inQuotes(names[0]) + " and " +
        inQuotes(names[1]) + ", and none is marked as Scalars; save the one to press");
  }
  points.SetActiveScalars(names[0].c_str());
}

} // namespace

PatientImage readVti(const std::filesystem::path& file)
{
  checkVtiHeader(file);
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!reader->GetOutput()->GetDirectionMatrix()->IsIdentity())
  {
    refuseTurned(file);
  }
  findScalars(file, *reader->GetOutput());
  PatientImage result = straight(reader->GetOutput());
  if (auto* unit =
        vtkStringArray::SafeDownCast(result.image->GetFieldData()->GetAbstractArray(kUnitArray)))
  {
    result.unit = unit->GetNumberOfValues() == 1 ? unit->GetValue(0) : vtkStdString();
  }
  return result;
}

std::uintmax_t claimedBytes(const std::filesystem::path& file) noexcept
{
  try
  {
    const std::string name = file.filename().string();
    const auto ends = [&](const char* ending) { return name.ends_with(ending); };
    return ends(".mha") || ends(".mhd") ? readMetaHeader(file).bytes
      : ends(".nii") || ends(".nii.gz") ? readNiftiHeader(file).bytes
      : ends(".vti")                    ? vtiBytes(file)
      : ends(".nrrd")                   ? nrrdBytes(file)
                                        : 0;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

} // namespace palp

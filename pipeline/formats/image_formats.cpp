#include "pipeline/formats/image_formats.h"

#include "haptics/files/csv_text.h"
#include "pipeline/formats/images/meta_image.h"
#include "pipeline/formats/images/nifti_header.h"
#include "pipeline/formats/images/nrrd_image.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/vti_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>

namespace palp
{
namespace
{

constexpr std::array kIdentity{ 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
  0.0, 0.0, 1.0 };

constexpr const char* kPatientAxes = "in the patient's axes to left, back and head (LPS)";

PatientImage straight(vtkSmartPointer<vtkImageData> image)
{
  PatientImage result{ .image = std::move(image), .toPatient = {} };
  std::copy(kIdentity.begin(), kIdentity.end(), result.toPatient);
  return result;
}

const char* niftiUnit(int code)
{
  constexpr int spatial = 7; // the other bits are of time
  switch (code & spatial)
  {
    case 1:
      return "m";
    case 2:
      return "mm";
    case 3:
      return "um";
    default:
      return "";
  }
}

} // namespace

PatientImage readMetaImage(const std::filesystem::path& file)
{
  const MetaHeader header = readMetaHeader(file);
  PatientImage result = straight(readMetaVolume(file, header));
  result.slope = header.slope;
  result.intercept = header.intercept;
  result.unit = header.unit;
  result.space = "LPS";
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      result.toPatient[4 * i + k] = header.axes[3 * k + i];
    }
    result.toPatient[4 * i + 3] = header.origin[i];
  }
  result.notes.emplace_back(kPatientAxes);
  if (!header.contradiction.empty())
  {
    result.notes.push_back("warning: " + header.contradiction);
  }
  return result;
}

// that of the sform where it is another than that of pixdim; empty: it is the same
std::string otherSize(vtkNIFTIImageReader& reader)
{
  constexpr double kAlike = 0.01;
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkMatrix4x4& form = *reader.GetSFormMatrix(); // without pixdim
    const double growth =
      std::hypot(form.GetElement(0, axis), form.GetElement(1, axis), form.GetElement(2, axis));
    if (std::abs(growth - 1.0) > kAlike)
    {
      const double side = reader.GetOutput()->GetSpacing()[axis];
      std::ostringstream words;
      words << side << " and its sform of " << side * growth << " along axis " << axis + 1;
      return words.str();
    }
  }
  return {};
}

// programs differ in which of the two forms they take: of another size one of them is wrong
void compareForms(
  const std::filesystem::path& file, vtkNIFTIImageReader& reader, std::vector<std::string>& notes)
{
  const std::string sizes = otherSize(reader);
  if (!reader.GetQFormMatrix())
  {
    sizes.empty()
      ? void()
      : notes.push_back("warning: its pixdim has voxels of " + sizes + "; the sform is taken");
    return;
  }
  if (!sizes.empty())
  {
    refuse(file, "its qform has voxels of " + sizes + "; set the code of the wrong one to 0");
  }
  vtkMatrix4x4& rigid = *reader.GetQFormMatrix(); // of the sides that pixdim tells
  vtkMatrix4x4& affine = *reader.GetSFormMatrix();
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
  if (reader.GetSFormMatrix())
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
  image.space = form ? "LPS" : "";
  image.notes.emplace_back(form
      ? std::string(kPatientAxes) + ", turned from NIfTI's to right, front and head (RAS)"
      : "the header tells no place in the patient; axes and corner of the voxels are taken");
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
  if (!std::isfinite(result.slope) || result.slope == 0.0) // as they are stored: nifti1_io.c
  {
    result.slope = 1.0;
    result.intercept = 0.0;
  }
  result.intercept = std::isfinite(result.intercept) ? result.intercept : 0.0;
  if (vtkNIFTIImageHeader* header = reader->GetNIFTIHeader())
  {
    result.unit = niftiUnit(header->GetXYZTUnits());
  }
  return result;
}

void takeSides(const std::filesystem::path& file, PatientImage& volume)
{
  double spacing[3];
  double origin[3];
  volume.image->GetSpacing(spacing);
  volume.image->GetOrigin(origin);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto form = [&](std::size_t i) -> double& { return volume.toPatient[4 * i + k]; };
    const double side = std::hypot(form(0), form(1), form(2));
    const double length = std::abs(spacing[k]) * side;
    if (!(length > 0.0 && std::isfinite(length)))
    {
      return; // nor do the axes span space, by which it is refused
    }
    constexpr double kShortest = 1e-8; // of micrometers in meters, and the other way around
    if (length < kShortest || length > 1.0 / kShortest)
    {
      refuse(file,
        "a voxel of its header is " + shortest(length) + " long along axis " +
          std::to_string(k + 1) + ", as none is; export it again");
    }
    spacing[k] *= side;
    origin[k] *= side;
    for (std::size_t i = 0; i < 3; ++i)
    {
      form(i) /= side;
    }
  }
  volume.image->SetSpacing(spacing);
  volume.image->SetOrigin(origin);
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
      : ends(".nrrd") || ends(".nhdr")  ? nrrdBytes(file)
                                        : 0;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

} // namespace palp

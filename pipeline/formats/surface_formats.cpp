#include "pipeline/formats/surface_formats.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/image_formats.h"
#include "pipeline/formats/images/nrrd_image.h"
#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/formats/meshes/stated_space.h"
#include "pipeline/formats/meshes/surface_readers.h"
#include "pipeline/formats/msh_format.h"
#include "pipeline/formats/read_limits.h"
#include "pipeline/formats/regions/image_labels.h"
#include "pipeline/formats/regions/image_surface.h"
#include "pipeline/formats/value_formats.h"
#include "pipeline/formats/vti_image.h"
#include "pipeline/formats/vtk_formats.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/process/dicom_mark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>

namespace palp
{
namespace
{

struct Format
{
  const char* ending;
  const char* name;
  const char* signature; // how such a file begins; empty: in many ways
  vtkSmartPointer<vtkPolyData> (*read)(const std::filesystem::path&); // null: an image
  PatientImage (*readImage)(const std::filesystem::path&) = nullptr;
};

constexpr std::array kFormats{ Format{ ".stl", "STL", "", readStl },
  Format{ ".obj", "OBJ", "", readObj }, Format{ ".ply", "PLY", "ply", readPly },
  Format{ ".off", "OFF", "", readOff }, Format{ ".vtk", "legacy VTK", "# vtk DataFile", readVtk },
  Format{ ".vtp", "VTP", "<", readVtp }, Format{ ".vtu", "VTU", "<", readVtu },
  Format{ ".msh", "MSH", "", readMsh }, Format{ ".mha", "MetaImage", "", nullptr, readMetaImage },
  Format{ ".mhd", "MetaImage", "", nullptr, readMetaImage },
  Format{ ".nii", "NIfTI", "", nullptr, readNifti },
  Format{ ".nii.gz", "NIfTI", "", nullptr, readNifti },
  Format{ ".nrrd", "NRRD", "NRRD000", nullptr, readNrrd },
  Format{ ".nhdr", "NRRD", "NRRD000", nullptr, readNrrd },
  Format{ ".vti", "VTI", "<", nullptr, readVti }, Format{ ".dcm", "DICOM", "", nullptr } };

constexpr Format kDicomFolder{ "/", "DICOM", "", nullptr };

// of other programs, with the way out
constexpr std::array kOthers{ std::pair{
                                ".glb", "a scene of glTF; export its mesh as .ply or .stl, in mm" },
  std::pair{ ".gltf", "a scene of glTF; export its mesh as .ply or .stl, in mm" },
  std::pair{ ".3mf", "a package of 3MF; save its mesh as .stl" },
  std::pair{ ".step", "a CAD model; export its surface as .stl" },
  std::pair{ ".stp", "a CAD model; export its surface as .stl" },
  std::pair{ ".json", "no surface or image; give a scene to palp scene" },
  std::pair{ ".hdr", "the header of an image in two files; save it as one .nii" },
  std::pair{ ".img", "an image in two files; save it as one .nii" },
  std::pair{ ".mgz", "an image of FreeSurfer; save it by mri_convert as .nii.gz" } };

void checkThere(const std::filesystem::path& file)
{
  if (std::error_code why; !std::filesystem::exists(file, why))
  {
    refuse(file,
      why == std::errc::permission_denied ? "cannot be opened; check its permissions"
                                          : "not found; check the name");
  }
}

[[noreturn]] void refuseOther(const std::filesystem::path& file, const std::string& name)
{
  checkThere(file);
  for (const auto& [ending, what] : kOthers)
  {
    if (name.ends_with(ending))
    {
      refuse(file, what);
    }
  }
  refuse(file,
    "not a kind of file known here; give a surface (.stl, .obj, .ply, .off, .vtk, .vtp, .vtu, "
    ".msh), an image (.mha, .mhd, .nii, .nii.gz, .nrrd, .nhdr, .vti), a folder of DICOM images or "
    "a DICOM segmentation (.dcm)");
}

const Format& formatOf(const std::filesystem::path& file)
{
  if (std::error_code why; std::filesystem::is_directory(file, why))
  {
    (void)std::filesystem::directory_iterator(file, why);
    why ? refuse(file, "cannot be opened; check its permissions") : void();
    return kDicomFolder;
  }
  const std::string name = lowered(file.filename().string());
  for (const Format& format : kFormats)
  {
    if (name.ends_with(format.ending))
    {
      return format;
    }
  }
  if (hasDicomMark(file))
  {
    return kFormats.back();
  }
  refuseOther(file, name);
}

void checkFile(const std::filesystem::path& file, const Format& format)
{
  checkThere(file);
  if (std::error_code failure; !std::filesystem::is_regular_file(file, failure))
  {
    refuse(file, "not a file; name a surface file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in)
  {
    refuse(file, "cannot be opened; check its permissions");
  }
  if (in.peek() == std::ifstream::traits_type::eof())
  {
    refuse(file, "empty; export it again");
  }
  std::string start(std::strlen(format.signature), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != format.signature)
  {
    refuse(
      file, std::string("not a ") + format.name + " file, whatever its name; rename or convert it");
  }
}

// a reader passes on whatever indices the file holds
bool indicesInRange(vtkCellArray& cells, vtkIdType points)
{
  if (!cells.IsValid())
  {
    return false;
  }
  double range[2] = { 0.0, -1.0 };
  cells.GetNumberOfCells() > 0 ? cells.GetConnectivityArray()->GetRange(range) : void();
  return range[0] >= 0.0 && range[1] < static_cast<double>(points);
}

void checkPoints(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points)
{
  constexpr double most = 1e12; // keeps every product of coordinates finite
  const auto isUsable = [](const Eigen::Vector3d& p)
  { return std::abs(p.x()) < most && std::abs(p.y()) < most && std::abs(p.z()) < most; };
  const auto odd = std::ranges::find_if_not(points, isUsable);
  if (odd != points.end())
  {
    throw Error(ErrorCode::BadMesh,
      file.string() + ": point " + std::to_string(odd - points.begin() + 1) +
        " has a coordinate that is not a usable number; repair the surface");
  }
}

std::string fieldOf(vtkPolyData& data, const char* name)
{
  auto* words = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray(name));
  return words && words->GetNumberOfValues() == 1 ? words->GetValue(0) : std::string();
}

// also of faces with more corners, and of strips
std::vector<Triangle> allTriangles(vtkPolyData& data)
{
  constexpr vtkIdType kCorners = 3;
  if (data.GetPolys()->IsHomogeneous() == kCorners && data.GetStrips()->GetNumberOfCells() == 0)
  {
    return trianglesOf(data);
  }
  vtkNew<vtkTriangleFilter> cut;
  cut->PassVertsOff();
  cut->PassLinesOff();
  cut->SetInputData(&data);
  cut->Update();
  return trianglesOf(*cut->GetOutput());
}

FileSurface surfaceOf(const std::filesystem::path& file, vtkPolyData& data)
{
  const vtkIdType points = data.GetNumberOfPoints();
  if (points > std::numeric_limits<int>::max())
  {
    throw Error(ErrorCode::BadMesh, file.string() + ": too many points; export a coarser surface");
  }
  if (!indicesInRange(*data.GetPolys(), points) || !indicesInRange(*data.GetStrips(), points))
  {
    refuse(file, "a triangle names a point that is not there; export it again");
  }
  FileSurface surface{ .points = pointsOf(data),
    .triangles = {},
    .unit = fieldOf(data, kUnitArray),
    .notes = {},
    .space = fieldOf(data, kSpaceArray) };
  checkPoints(file, surface.points);
  surface.triangles = allTriangles(data);
  if (surface.triangles.empty())
  {
    throw Error(ErrorCode::BadMesh,
      file.string() + ": no triangles in it; export a surface, not points or a volume");
  }
  turnToLps(file, surface);
  return surface;
}

// what VTK complains of ends the work
template <typename Read>
auto withoutVtkErrors(const std::filesystem::path& file, const Format& format, Read read)
{
  throwVtkErrors();
  try
  {
    return read();
  }
  catch (const VtkError& error)
  {
    const bool isTooLarge = error.text.find("nable to allocate") != std::string::npos;
    refuse(file,
      isTooLarge ? "its header counts more than there is memory for; export it again"
                 : std::string("cannot be read as ") + format.name + " (" + error.text +
          "); export it again");
  }
}

PatientImage imageOf(const std::filesystem::path& file, const Format& format, const ImagePart& part,
  const DicomReaders& dicom)
{
  checkFits(file);
  if (format.readImage == nullptr && dicom.series == nullptr)
  {
    refuse(file, "DICOM is read by palp-read-dicom, which is not there; build or install it");
  }
  PatientImage volume = format.readImage ? format.readImage(file)
    : &format == &kDicomFolder           ? dicom.series(file, part.series)
                                         : dicom.segments(file);
  takeSides(file, volume);
  giveNames(volume, part.names);
  return volume;
}

const Format& checkedFormat(const std::filesystem::path& file, const ImagePart& part)
{
  const Format& format = formatOf(file);
  &format == &kDicomFolder ? void() : checkFile(file, format);
  if (&format != &kDicomFolder && !part.series.empty())
  {
    refuse(file, "no folder of DICOM images; leave the series out");
  }
  return format;
}

} // namespace

FileSurface readFile(
  const std::filesystem::path& file, const ImagePart& part, const DicomReaders& dicom)
{
  constexpr double kRead = 0.6; // about, of all the time
  const Format& format = checkedFormat(file, part);
  if (format.read && (part.level || part.band || !part.labels.empty()))
  {
    const char* what = part.level ? "level" : part.band ? "values" : "label";
    refuse(file, std::string("a surface, not an image; leave the ") + what + " out");
  }
  return withoutVtkErrors(file, format,
    [&]
    {
      if (format.read)
      {
        const auto data = format.read(file);
        answerProgress(kRead);
        return surfaceOf(file, *data);
      }
      const PatientImage volume = imageOf(file, format, part, dicom);
      answerProgress(kRead);
      FileSurface surface = imageSurface(volume, part, file.string());
      checkPoints(file, surface.points);
      return surface;
    });
}

FileValues readValues(
  const std::filesystem::path& file, const std::string& array, const DicomReaders& dicom)
{
  const Format& format = checkedFormat(file, {});
  if (array.empty() != (format.read == nullptr))
  {
    refuse(file,
      array.empty() ? "a surface, not an image; name an array of it"
                    : "an image, not a surface; it has no arrays to name");
  }
  return withoutVtkErrors(file, format,
    [&]
    {
      return format.read ? arrayValues(*format.read(file), array, file)
                         : imageValues(imageOf(file, format, {}, dicom), file);
    });
}

FileOrgans readOrgans(const std::filesystem::path& file, const ImagePart& part,
  const OrgansAsked& asked, const DicomReaders& dicom)
{
  const Format& format = checkedFormat(file, part);
  if (format.read)
  {
    refuse(file, "a surface already, not an image; press it as it is, or repair it by palp check");
  }
  return withoutVtkErrors(file, format,
    [&]
    {
      FileOrgans all = imageOrgans(imageOf(file, format, part, dicom), part, asked, file.string());
      for (const FileOrgan& organ : all.organs)
      {
        checkPoints(file, organ.surface.points);
      }
      return all;
    });
}

} // namespace palp

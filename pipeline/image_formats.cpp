#include "pipeline/image_formats.h"

#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkSynchronizedTemplates3D.h>
#include <vtkWindowedSincPolyDataFilter.h>
#include <vtkXMLImageDataReader.h>

namespace palp
{
namespace
{

constexpr std::array kIdentity{ 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
  0.0, 0.0, 1.0 };

[[noreturn]] void refuseTurned(const std::filesystem::path& file)
{
  throw Error(ErrorCode::BadFile,
    file.string() + ": its axes are turned, which is read from NIfTI only; save it as .nii.gz");
}

PatientImage straight(vtkSmartPointer<vtkImageData> image)
{
  PatientImage result{ .image = std::move(image), .toPatient = {} };
  std::copy(kIdentity.begin(), kIdentity.end(), result.toPatient);
  return result;
}

// what VTK passes over in the text that a MetaImage begins with
struct MetaHeader
{
  bool turned = false;
  bool compressed = false;
  std::uintmax_t compressedSize = 0; // [bytes]
  std::string dataFile;              // LOCAL: behind the header
  std::uintmax_t end = 0;            // of the header [bytes]
};

MetaHeader readMetaHeader(const std::filesystem::path& file)
{
  MetaHeader header;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; header.dataFile.empty() && std::getline(in, line);)
  {
    std::istringstream fields(line);
    std::string key;
    std::string equals;
    fields >> key >> equals;
    if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation")
    {
      double value = 0.0;
      for (int i = 0; fields >> value; ++i)
      {
        header.turned = header.turned || value != (i % 4 == 0 ? 1.0 : 0.0); // 3 x 3, row by row
      }
    }
    else if (key == "CompressedData")
    {
      std::string word;
      header.compressed = fields >> word && word == "True";
    }
    else if (key == "CompressedDataSize")
    {
      fields >> header.compressedSize;
    }
    else if (key == "ElementDataFile")
    {
      fields >> header.dataFile;
      header.end = static_cast<std::uintmax_t>(in.tellg());
    }
  }
  return header;
}

// VTK takes what is missing at the end for whatever the memory held
void checkWhole(const std::filesystem::path& file, const MetaHeader& header, vtkImageData& image)
{
  const bool local = header.dataFile == "LOCAL";
  std::error_code failure;
  const std::uintmax_t there = local
    ? std::filesystem::file_size(file) - header.end
    : std::filesystem::file_size(file.parent_path() / header.dataFile, failure);
  const std::uintmax_t needed = header.compressed
    ? header.compressedSize
    : static_cast<std::uintmax_t>(image.GetNumberOfPoints()) *
      static_cast<std::uintmax_t>(image.GetScalarSize() * image.GetNumberOfScalarComponents());
  if (header.dataFile.empty() || failure || there < needed)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cut off, or without its data; export or copy it again");
  }
}

} // namespace

PatientImage readMetaImage(const std::filesystem::path& file)
{
  const MetaHeader header = readMetaHeader(file);
  if (header.turned)
  {
    refuseTurned(file);
  }
  vtkNew<vtkMetaImageReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  checkWhole(file, header, *reader->GetOutput());
  return straight(reader->GetOutput());
}

PatientImage readNifti(const std::filesystem::path& file)
{
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  PatientImage result = straight(reader->GetOutput());
  // the better of the two forms a header may have; both lead to right, front, head
  vtkMatrix4x4* form =
    reader->GetSFormMatrix() ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  if (form)
  {
    std::copy_n(form->GetData(), 16, result.toPatient);
    for (int i = 0; i < 8; ++i) // x and y
    {
      result.toPatient[i] = -result.toPatient[i];
    }
  }
  return result;
}

PatientImage readVti(const std::filesystem::path& file)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!reader->GetOutput()->GetDirectionMatrix()->IsIdentity())
  {
    refuseTurned(file);
  }
  return straight(reader->GetOutput());
}

vtkSmartPointer<vtkPolyData> levelSurface(
  const PatientImage& volume, std::optional<double> level, const std::string& name)
{
  const auto refuse = [&](const std::string& what)
  { throw Error(ErrorCode::BadMesh, name + ": " + what); };
  vtkImageData& image = *volume.image;
  const int* size = image.GetDimensions();
  vtkDataArray* values = image.GetPointData()->GetScalars();
  if (!values || std::min({ size[0], size[1], size[2] }) < 2)
  {
    refuse("no volume in it; give an image of two slices or more");
  }
  if (values->GetNumberOfComponents() != 1)
  {
    refuse("several values at each voxel; give an image of one");
  }
  const double* range = values->GetRange();
  std::ostringstream known;
  known << "its values go from " << range[0] << " to " << range[1];
  if (!level)
  {
    refuse("an image; name the value of the surface with a level, " + known.str());
  }
  if (!(*level > range[0] && *level < range[1]))
  {
    std::ostringstream what;
    what << "no surface at level " << *level << "; " << known.str();
    refuse(what.str());
  }

  vtkNew<vtkSynchronizedTemplates3D> contour; // starts no thread, unlike its newer kin
  contour->SetInputData(&image);
  contour->SetValue(0, *level);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  vtkNew<vtkPolyDataConnectivityFilter> largest;
  largest->SetInputConnection(contour->GetOutputPort());
  largest->SetExtractionModeToLargestRegion();
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputConnection(largest->GetOutputPort());
  smooth->SetNumberOfIterations(20);
  smooth->SetPassBand(0.1); // a stair of one voxel goes, what is larger stays
  smooth->NormalizeCoordinatesOn();
  smooth->BoundarySmoothingOff();
  smooth->Update();

  vtkSmartPointer<vtkPolyData> surface = smooth->GetOutput();
  vtkNew<vtkMatrix4x4> toPatient;
  toPatient->DeepCopy(volume.toPatient);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* p = surface->GetPoint(i);
    const double from[4] = { p[0], p[1], p[2], 1.0 };
    double to[4];
    toPatient->MultiplyPoint(from, to);
    surface->GetPoints()->SetPoint(i, to);
  }
  return surface;
}

} // namespace palp

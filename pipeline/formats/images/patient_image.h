#pragma once

#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;

namespace palp
{

/// A region of a label map that has a name.
struct Segment
{
  std::string name;
  double value = 1.0;     ///< of its voxels, as they are stored
  std::string color{};    ///< #rrggbb; empty: none
  int layer = 0;          ///< component of the voxels in which they have it: regions may overlap
  bool isOfTable = false; ///< its name stands in a table alone, which may be of more than an image
};

/// A volume, what its numbers mean, and what brings its points into the patient's axes: x to the
/// left, y to the back, z to the head (LPS).
struct PatientImage
{
  vtkSmartPointer<vtkImageData> image;
  double toPatient[16]; ///< row by row, applied to the image's own points [unit]
  double slope = 1.0;   ///< a voxel's value is slope times what is stored, plus intercept
  double intercept = 0.0;
  std::string unit{};  ///< of its points: "um", "mm", "cm", "m"; empty: the file names none
  std::string space{}; ///< of those axes: "LPS"; empty: the file tells no place in the patient
  std::vector<std::string> notes{}; ///< how it was taken, for people
  std::vector<Segment> segments{};  ///< that the file names
};

} // namespace palp

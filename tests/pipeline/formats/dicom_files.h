#pragma once

#include "tests/pipeline/surface_files.h"
#include "tests/support/dicom_series.h"

namespace palp::test
{

/// Series of DICOM images in a folder of their own.
class DicomFiles : public Files
{
protected:
  [[nodiscard]] std::string refusal(
    const std::string& name, ImagePart part = { .level = kDicomLevel })
  {
    try
    {
      (void)readSurface(folder_.path() / name, {}, part);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "taken";
  }
};

inline const DicomGrid kAxial{ 40, 36, 14, { -57.3, 21.4, 803.2 }, Eigen::Vector3d::UnitX(),
  Eigen::Vector3d::UnitY(), 0.8, 0.9, 2.5 };

} // namespace palp::test

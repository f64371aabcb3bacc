// palp-read FILE [joined|organs|some|list|values] [KEY=VALUE...]: reads a surface, the bodies in an
// image, their list or values for the program that started it. DICOM it leaves to a sibling.
#include "haptics/files/input_text.h"
#include "haptics/files/prefix.h"
#include "pipeline/formats/read_program.h"
#include "pipeline/process/dicom_mark.h"

#include <unistd.h>

namespace
{

bool isDicom(const std::filesystem::path& file)
{
  std::error_code none;
  return std::filesystem::is_directory(file, none) ||
    palp::lowered(file.extension().string()) == ".dcm" || palp::hasDicomMark(file);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc > 1 && isDicom(argv[1]))
  {
    execv((palp::prefix() / "bin/palp-read-dicom").c_str(), argv); // where it is not, that is told
  }
  palp::readForAnother(argc, argv, {});
}

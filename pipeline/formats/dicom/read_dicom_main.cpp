// palp-read-dicom: palp-read for images of DICOM, with the library that they need.
#include "pipeline/formats/dicom/dicom_image.h"
#include "pipeline/formats/dicom/dicom_segments.h"
#include "pipeline/formats/read_program.h"

int main(int argc, char** argv)
{
  palp::readForAnother(
    argc, argv, { .series = palp::readDicom, .segments = palp::readDicomSegments });
}

#include "pipeline/charts/plot_files.h"

#include "haptics/error.h"
#include "haptics/files/replace_file.h"
#include "pipeline/charts/vtkPalpLineCapture.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>
#include <vtk_gl2ps.h>

namespace palp
{
namespace
{

// a context that came up but draws nothing leaves every pixel alike
bool uniform(vtkImageData& image)
{
  const auto* pixels = static_cast<const unsigned char*>(image.GetScalarPointer());
  const vtkIdType components = image.GetNumberOfScalarComponents();
  for (vtkIdType i = components; i < image.GetNumberOfPoints() * components; ++i)
  {
    if (pixels[i] != pixels[i - components])
    {
      return false;
    }
  }
  return true;
}

// What is drawn over nothing has its color weakened by its own share of the pixel; a file has the
// color itself beside the share.
void restoreColors(vtkImageData& image)
{
  auto* pixels = static_cast<unsigned char*>(image.GetScalarPointer());
  for (vtkIdType i = 0; i < image.GetNumberOfPoints(); ++i)
  {
    unsigned char* pixel = pixels + 4 * i;
    const int share = pixel[3];
    for (int k = 0; k < 3 && share > 0; ++k)
    {
      pixel[k] = static_cast<unsigned char>(std::min(255, (255 * pixel[k] + share / 2) / share));
    }
  }
}

// blanked out, as a PDF counts its bytes; false for a file that does not end as it should
bool removeDate(const std::filesystem::path& file, std::string_view end)
{
  std::ifstream in(file, std::ios::binary);
  std::string text{ std::istreambuf_iterator<char>(in), {} };
  if (text.rfind(end) == text.npos)
  {
    return false;
  }
  const std::size_t date = std::min(text.find("/CreationDate"), text.find("CreationDate"));
  if (date != text.npos)
  {
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(date),
      std::find(text.begin() + static_cast<std::ptrdiff_t>(date), text.end(), '\n'), ' ');
  }
  return static_cast<bool>(std::ofstream(file, std::ios::binary) << text << std::flush);
}

// lines and text; the same picture gives the same bytes
void writeLines(
  vtkRenderWindow& window, const std::filesystem::path& file, int format, std::string_view end)
{
  window.Render();
  replaceFile(file,
    [&](const std::filesystem::path& fresh)
    {
      const std::unique_ptr<FILE, int (*)(FILE*)> out(std::fopen(fresh.c_str(), "wb"), std::fclose);
      out == nullptr ? refuseFile(fresh, errno) : void();
      vtkNew<vtkPalpLineCapture>()->Write(&window, format, out.get());
      if (!removeDate(fresh, end)) // it does not tell whether it wrote
      {
        refuseFile(fresh, ENOSPC);
      }
    });
}

} // namespace

void writeCsv(std::span<const std::unique_ptr<Plot>> plots, const std::filesystem::path& file)
{
  std::ostringstream out;
  for (const auto& plot : plots)
  {
    out << (&plot == &plots.front() ? "" : "\n");
    plot->writeCsv(out);
  }
  replaceFile(file, out.view());
}

vtkSmartPointer<vtkImageData> pictureOf(vtkRenderWindow& window, Backdrop background)
{
  const bool isTransparent = background == Backdrop::Transparent;
  if (isTransparent)
  {
    window.SetAlphaBitPlanes(1);
  }
  window.Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  isTransparent ? grab->SetInputBufferTypeToRGBA() : grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->Update();
  return grab->GetOutput();
}

void writePng(vtkImageData& picture, const std::filesystem::path& file)
{
  if (uniform(picture))
  {
    throw Error(ErrorCode::NoPicture,
      shownName(file) +
        ": the picture came out empty; check the OpenGL driver, or pass --no-picture");
  }
  if (picture.GetNumberOfScalarComponents() == 4)
  {
    restoreColors(picture);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&picture);
  writer->WriteToMemoryOn(); // libpng would tell of a full disk in its own words
  writer->Write();
  vtkUnsignedCharArray& png = *writer->GetResult();
  replaceFile(file,
    std::string_view(reinterpret_cast<const char*>(png.GetPointer(0)),
      static_cast<std::size_t>(png.GetNumberOfValues())));
}

void writePng(vtkRenderWindow& window, const std::filesystem::path& file, Backdrop background)
{
  writePng(*pictureOf(window, background), file);
}

void writeSvg(vtkRenderWindow& window, const std::filesystem::path& file)
{
  writeLines(window, file, GL2PS_SVG, "</svg>");
}

void writePdf(vtkRenderWindow& window, const std::filesystem::path& file)
{
  writeLines(window, file, GL2PS_PDF, "%%EOF");
}

} // namespace palp

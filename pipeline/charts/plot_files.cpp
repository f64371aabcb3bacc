#include "pipeline/charts/plot_files.h"

#include "haptics/error.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vtkGL2PSExporter.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

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
  vtkNew<vtkGL2PSExporter> exporter;
  exporter->SetRenderWindow(&window);
  exporter->SetFileFormat(format);
  exporter->SetTitle("palp");
  exporter->CompressOff();
  exporter->SetSortToOff();
  exporter->SilentOn(); // else it complains of the background, which it cannot embed
  // a PDF's own fonts have no Greek letters
  exporter->SetTextAsPath(format == vtkGL2PSExporter::PDF_FILE);
  replaceFile(file,
    [&](const std::filesystem::path& fresh)
    {
      exporter->SetFilePrefix((fresh.parent_path() / fresh.stem()).c_str());
      exporter->Write();
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
  writeLines(window, file, vtkGL2PSExporter::SVG_FILE, "</svg>");
}

void writePdf(vtkRenderWindow& window, const std::filesystem::path& file)
{
  writeLines(window, file, vtkGL2PSExporter::PDF_FILE, "%%EOF");
}

} // namespace palp

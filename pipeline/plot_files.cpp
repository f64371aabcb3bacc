#include "pipeline/plot_files.h"

#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <vtkGL2PSExporter.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file)
{
  throw Error(
    ErrorCode::BadFile, file.string() + ": cannot be written; check space and permissions");
}

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

bool isWholeSvg(const std::filesystem::path& file)
{
  constexpr std::streamoff kTail = 32;
  if (!std::filesystem::is_regular_file(file))
  {
    return false;
  }
  std::ifstream in(file, std::ios::binary);
  in.seekg(0, std::ios::end);
  in.seekg(std::max<std::streamoff>(0, in.tellg() - kTail));
  const std::string tail{ std::istreambuf_iterator<char>(in), {} };
  return tail.find("</svg>") != std::string::npos;
}

} // namespace

void writeCsv(std::span<const std::unique_ptr<Plot>> plots, const std::filesystem::path& file)
{
  std::ofstream out(file);
  for (const auto& plot : plots)
  {
    out << (&plot == &plots.front() ? "" : "\n");
    plot->writeCsv(out);
  }
  if (!out.flush())
  {
    refuse(file);
  }
}

void writePng(vtkRenderWindow& window, const std::filesystem::path& file)
{
  window.Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  grab->Update();
  if (uniform(*grab->GetOutput()))
  {
    throw Error(ErrorCode::NoPicture,
      file.string() +
        ": the picture came out empty; check the OpenGL driver, or pass --no-picture");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputConnection(grab->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    refuse(file);
  }
}

void writeSvg(vtkRenderWindow& window, const std::filesystem::path& file)
{
  if (std::filesystem::is_regular_file(file))
  {
    std::filesystem::remove(file); // the exporter does not tell whether it wrote
  }
  window.Render();
  vtkNew<vtkGL2PSExporter> exporter;
  exporter->SetRenderWindow(&window);
  exporter->SetFileFormatToSVG();
  exporter->CompressOff();
  exporter->SetSortToOff();
  exporter->SilentOn(); // else it complains of the background, which it cannot embed
  exporter->SetTextAsPath(false);
  exporter->SetFilePrefix((file.parent_path() / file.stem()).c_str());
  exporter->Write();
  if (!isWholeSvg(file))
  {
    refuse(file);
  }
}

void writePdf(vtkRenderWindow& window, const std::filesystem::path& file)
{
  const std::filesystem::path pdf = std::filesystem::absolute(file); // begins with no dash
  const std::filesystem::path svg = pdf.string() + ".svg";
  writeSvg(window, svg);
  std::array<std::string, 6> words{ "rsvg-convert", "--format=pdf", "--background-color=white",
    "--output", pdf.string(), svg.string() };
  std::array<char*, 7> arguments{};
  std::transform(
    words.begin(), words.end(), arguments.begin(), [](std::string& word) { return word.data(); });
  pid_t child = 0;
  int status = 1;
  const bool started =
    posix_spawnp(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) == 0;
  while (started && waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  std::filesystem::remove(svg);
  if (!started || status != 0)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": rsvg-convert made no PDF; install librsvg2-bin, or take svg");
  }
}

} // namespace palp

#include "pipeline/plot_files.h"

#include "calibration/replace_file.h"
#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
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

bool isWholeSvg(const std::filesystem::path& file)
{
  constexpr std::streamoff kTail = 32;
  std::ifstream in(file, std::ios::binary);
  in.seekg(0, std::ios::end);
  in.seekg(std::max<std::streamoff>(0, in.tellg() - kTail));
  const std::string tail{ std::istreambuf_iterator<char>(in), {} };
  return tail.find("</svg>") != std::string::npos;
}

// whether rsvg-convert made a PDF; it does so in silence
bool convert(const std::filesystem::path& svg, const std::filesystem::path& pdf)
{
  std::array<std::string, 6> words{ "rsvg-convert", "--format=pdf", "--background-color=white",
    "--output", pdf.string(), svg.string() };
  std::array<char*, 7> arguments{};
  std::transform(
    words.begin(), words.end(), arguments.begin(), [](std::string& word) { return word.data(); });
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  int status = 1;
  const bool started =
    posix_spawnp(&child, words[0].c_str(), &files, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  while (started && waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  return started && status == 0;
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
      shownName(file) +
        ": the picture came out empty; check the OpenGL driver, or pass --no-picture");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->WriteToMemoryOn(); // libpng would tell of a full disk in its own words
  writer->Write();
  vtkUnsignedCharArray& png = *writer->GetResult();
  replaceFile(file,
    std::string_view(reinterpret_cast<const char*>(png.GetPointer(0)),
      static_cast<std::size_t>(png.GetNumberOfValues())));
}

void writeSvg(vtkRenderWindow& window, const std::filesystem::path& file)
{
  window.Render();
  vtkNew<vtkGL2PSExporter> exporter;
  exporter->SetRenderWindow(&window);
  exporter->SetFileFormatToSVG();
  exporter->CompressOff();
  exporter->SetSortToOff();
  exporter->SilentOn(); // else it complains of the background, which it cannot embed
  exporter->SetTextAsPath(false);
  replaceFile(file,
    [&](const std::filesystem::path& fresh)
    {
      exporter->SetFilePrefix((fresh.parent_path() / fresh.stem()).c_str());
      exporter->Write();
      if (!isWholeSvg(fresh)) // it does not tell whether it wrote
      {
        refuseFile(fresh, ENOSPC);
      }
    });
}

void writePdf(vtkRenderWindow& window, const std::filesystem::path& file)
{
  const auto make = [&](const std::filesystem::path& fresh)
  {
    const std::filesystem::path pdf = std::filesystem::absolute(fresh); // begins with no dash
    const std::filesystem::path svg = pdf.string() + ".svg";
    writeSvg(window, svg);
    if (!convert(svg, pdf))
    {
      throw Error(ErrorCode::BadFile,
        shownName(file) + ": rsvg-convert made no PDF; install librsvg2-bin, or take svg");
    }
  };
  replaceFile(file, make);
}

} // namespace palp

#include "app/draw/movie_file.h"

#include "haptics/error.h"
#include "pipeline/charts/plot_files.h"
#include "pipeline/process/child_process.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vtkRenderWindow.h>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

// as the shell finds it
fs::path findProgram(const char* name)
{
  const char* path = std::getenv("PATH"); // NOLINT(concurrency-mt-unsafe): nobody sets it
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    if (fs::path file = fs::path(folder) / name; access(file.c_str(), X_OK) == 0)
    {
      return file;
    }
  }
  return {};
}

[[noreturn]] void refuseMovie(const fs::path& file)
{
  throw Error(
    ErrorCode::BadFile, file.string() + ": the movie cannot be written; free some space there");
}

} // namespace

MovieFile::MovieFile(vtkRenderWindow& window, const fs::path& file, int rate)
  : window_(window)
  , file_(file)
  , rate_(rate)
  , ffmpeg_(findProgram("ffmpeg"))
{
  if (!ffmpeg_.empty())
  {
    file_ += ".mp4";
    std::string folder = (file_.parent_path() / ".frames-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
    {
      refuseMovie(file_);
    }
    frames_ = folder;
    return;
  }
  file_ += ".ogv";
  picture_->SetInput(&window_);
  picture_->SetInputBufferTypeToRGB();
  picture_->ReadFrontBufferOff();
  picture_->ShouldRerenderOff();
  theora_->SetInputConnection(picture_->GetOutputPort());
  theora_->SetFileName(file_.c_str());
  theora_->SetRate(rate_);
  theora_->SetQuality(2);
  theora_->Start();
}

MovieFile::~MovieFile()
{
  std::error_code ignored;
  frames_.empty() ? 0 : fs::remove_all(frames_, ignored);
}

void MovieFile::add()
{
  if (!ffmpeg_.empty())
  {
    const std::string number = std::to_string(100'000 + count_++);
    writePng(window_, frames_ / (number + ".png"));
    return;
  }
  window_.Render();
  picture_->Modified();
  theora_->Write();
  if (theora_->GetError() != 0)
  {
    refuseMovie(file_);
  }
}

void MovieFile::finish()
{
  if (ffmpeg_.empty())
  {
    theora_->End();
    return;
  }
  const std::string rate = std::to_string(rate_);
  const auto done =
    outputOf({ ffmpeg_.string(), "-loglevel", "error", "-y", "-framerate", rate, "-start_number",
      "100000", "-i", (frames_ / "%06d.png").string(), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
      "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", file_.string() });
  if (!done)
  {
    refuseMovie(file_);
  }
}

} // namespace palp

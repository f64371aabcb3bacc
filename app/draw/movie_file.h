#pragma once

#include <filesystem>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>
#include <vtkWindowToImageFilter.h>

class vtkRenderWindow;

namespace palp
{

/// A movie, picture by picture: H.264 in NAME.mp4 where ffmpeg is installed, else Theora in
/// NAME.ogv.
class MovieFile
{
public:
  /// @param window  that shows the pictures
  /// @param file    without an ending
  /// @throws Error  BadFile: cannot be written
  MovieFile(vtkRenderWindow& window, const std::filesystem::path& file, int rate);
  ~MovieFile();
  MovieFile(const MovieFile&) = delete;
  MovieFile& operator=(const MovieFile&) = delete;

  /// What the window shows now.
  /// @throws Error  BadFile: cannot be written
  void add();

  /// After the last picture.
  /// @throws Error  BadFile: cannot be written
  void finish();

private:
  vtkRenderWindow& window_;
  std::filesystem::path file_;
  int rate_;
  std::filesystem::path ffmpeg_; // empty: not there
  std::filesystem::path frames_; // for it, a folder; empty: none
  int count_ = 0;
  vtkNew<vtkWindowToImageFilter> picture_;
  vtkNew<vtkOggTheoraWriter> theora_;
};

} // namespace palp

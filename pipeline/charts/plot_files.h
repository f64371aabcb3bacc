#pragma once

#include "pipeline/charts/plot.h"

#include <filesystem>
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace palp
{

/// Writes the curves of charts, one after the other, an empty line between them.
/// @throws Error  BadFile: cannot be written
void writeCsv(std::span<const std::unique_ptr<Plot>> plots, const std::filesystem::path& file);

enum class Backdrop
{
  Opaque,
  Transparent ///< where the window's renderer leaves it so, black
};

/// What a window shows, drawn anew: red, green, blue, and alpha where it is transparent.
[[nodiscard]] vtkSmartPointer<vtkImageData> pictureOf(
  vtkRenderWindow& window, Backdrop background = Backdrop::Opaque);

/// Writes such a picture, on any thread.
/// @param picture  its colors change where it is transparent
/// @throws Error  as the other
void writePng(vtkImageData& picture, const std::filesystem::path& file);

/// Writes what a window shows.
/// @throws Error  BadFile: cannot be written; NoPicture: every pixel is alike
void writePng(vtkRenderWindow& window, const std::filesystem::path& file,
  Backdrop background = Backdrop::Opaque);

/// Writes what a window of charts shows as lines and text, not pixels; without a date, so that the
/// same picture gives the same bytes.
/// @param file    its name ends in .svg
/// @throws Error  BadFile: cannot be written
void writeSvg(vtkRenderWindow& window, const std::filesystem::path& file);

/// The same as PDF, its text as outlines.
/// @param file    its name ends in .pdf
/// @throws Error  BadFile: cannot be written
void writePdf(vtkRenderWindow& window, const std::filesystem::path& file);

} // namespace palp

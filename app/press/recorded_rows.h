#pragma once

#include "app/press/recording.h"

#include <filesystem>

namespace palp
{

/// Reads the samples of an exported samples.csv: when, where the tool was and what force the device
/// was sent, as they stand there to the last bit. Contact and law are computed anew.
///
/// @param recording  its scene is what was pressed; its samples are replaced
/// @throws Error     BadFile: unreadable, a column is missing, a row that is none; with the line
void readRows(Recording& recording, const std::filesystem::path& file);

} // namespace palp

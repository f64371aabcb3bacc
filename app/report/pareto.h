#pragma once

#include "app/report/document.h"

namespace palp::report
{

/// The rows of a table than which no other of their press and regime is faster and more accurate.
///
/// @param table    with columns method, setting, regime, and the front's time and error
/// @param setting  what all settings of the front begin with
/// @param without  a method that is left aside; "": none
/// @param front    receives rows of its columns front, method, setting, regime, TIME and ERROR,
///                 fastest first
void addParetoFront(Table& front, const std::string& name, const Table& table,
  const std::string& setting, const std::string& without);

} // namespace palp::report

#pragma once

#include "app/report/document.h"

namespace palp::report
{

/// The rows of a table than which no other of their press and regime is faster and more accurate.
///
/// @param table    with columns method, setting, regime, time_us and the error
/// @param error    column
/// @param setting  what all settings of the front begin with
/// @param without  a method that is left aside; "": none
/// @param front    receives rows front,method,setting,regime,time_us,ERROR, fastest first
void addParetoFront(Table& front, const std::string& name, const Table& table,
  const std::string& error, const std::string& setting, const std::string& without);

} // namespace palp::report

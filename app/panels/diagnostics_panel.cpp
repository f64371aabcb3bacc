#include "app/panels/diagnostics_panel.h"

#include <chrono>

namespace palp
{
namespace
{

QString microseconds(Histogram::Duration duration)
{
  using Micro = std::chrono::duration<double, std::micro>;
  return QString::number(Micro(duration).count(), 'f', 1);
}

QString timingRow(const QString& name, const Histogram& histogram)
{
  QString row = "<tr><td>" + name + "</td>";
  for (const double fraction : { 0.5, 0.99, 0.999 })
  {
    row += "<td align=right>&nbsp;" + microseconds(histogram.quantile(fraction)) + "</td>";
  }
  return row + "<td align=right>&nbsp;" + microseconds(histogram.longest()) + "</td></tr>";
}

} // namespace

DiagnosticsPanel::DiagnosticsPanel(QWidget* parent)
  : QLabel(parent)
{
  setObjectName("timing");
  setWordWrap(true);
  setTextFormat(Qt::RichText);
  setAlignment(Qt::AlignTop);
  setMargin(6);
}

void DiagnosticsPanel::show(const Timing& timing, const std::string& schedule)
{
  const auto ticks = timing.ticks.load();
  const auto late = timing.skipped.load();
  const double elapsed = timing.elapsed.load();
  const double rate = elapsed > 0.0 ? static_cast<double>(ticks) / elapsed : 0.0;
  const QString bus =
    timing.poseToForce.count() > 0 ? timingRow(tr("pose to force"), timing.poseToForce) : QString();
  setText(tr("Servo %1 Hz, %2 late ticks<br>").arg(rate, 0, 'f', 0).arg(late) +
    tr("<b>Times</b> [µs]<table><tr><td></td><td>&nbsp;p50</td><td>&nbsp;p99</td>"
       "<td>&nbsp;p99.9</td><td>&nbsp;max</td></tr>") +
    timingRow(tr("late by"), timing.lateness) + timingRow(tr("step"), timing.step) + bus +
    "</table>" + QString::fromStdString(schedule));
}

} // namespace palp

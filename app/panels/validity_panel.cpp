#include "app/panels/validity_panel.h"

#include "haptics/files/fixed_text.h"
#include "haptics/force/nodules/detection.h"
#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <QColor>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace palp
{
namespace
{

QString colorOf(double fraction)
{
  const appearance::Color& color = fraction > 1.0 ? appearance::kBad
    : fraction > Rule::kDoubtful                  ? appearance::kDoubtful
                                                  : appearance::kGood;
  return QColor::fromRgbF(color[0], color[1], color[2]).name();
}

QString number(const Rule& rule, double value)
{
  const std::string_view unit = rule.unit;
  return unit == "rad" ? QString::number(units::toDegrees(value), 'g', 3) + QStringLiteral("°")
    : unit == "N/m"
    ? QString::number(units::toNewtonsPerMillimeter(value), 'g', 3) + QStringLiteral(" N/mm")
    : QString::number(value, 'g', 3);
}

// how much of its limit; an error of the force as people compare those
QString useOf(const Rule& rule)
{
  const std::string_view name = rule.name;
  const bool isOfItself = name == "force_of_itself";
  if (isOfItself || name == "force_of_maximum")
  {
    return QStringLiteral("%1: %2 % (limit %3 %)")
      .arg(isOfItself ? "force error" : "error of full scale")
      .arg(100.0 * rule.value, 0, 'f', 0)
      .arg(100.0 * rule.limit, 0, 'f', 0);
  }
  return QStringLiteral("%1: %2 % of its limit (%3 of %4)")
    .arg(QString(rule.name).replace('_', ' '))
    .arg(100.0 * rule.fraction(), 0, 'f', 0)
    .arg(number(rule, rule.value), number(rule, rule.limit));
}

// a nodule in what people notice at least
QString contrastText(std::size_t number, double contrast)
{
  const std::string percent = fixed(100.0 * contrast, 1);
  const bool isMore = !percent.starts_with('-') && percent != fixed(0.0, 1);
  QString text = QStringLiteral("nodule %1: %2%3 % of the force<br>")
                   .arg(number)
                   .arg(isMore ? "+" : "", QString::fromStdString(percent));
  for (const JustNoticeable& difference : kJustNoticeable)
  {
    text += QStringLiteral("&nbsp;&nbsp;%1 times the %2 % that people notice of %3<br>")
              .arg(std::abs(difference.difference(contrast)) / difference.fraction, 0, 'f', 1)
              .arg(100.0 * difference.fraction, 0, 'f', 0)
              .arg(difference.name);
  }
  return text;
}

} // namespace

ValidityPanel::ValidityPanel(QWidget* parent)
  : QLabel(parent)
{
  setObjectName("rules");
  setWordWrap(true);
  setTextFormat(Qt::RichText);
  setAlignment(Qt::AlignTop);
  setMargin(6);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // the panel keeps its width
  showNoContact();
}

void ValidityPanel::showNoContact()
{
  setText(tr("no contact"));
}

void ValidityPanel::showRules(std::span<const Rule> rules, std::span<const double> contrasts)
{
  std::vector<Rule> sorted(rules.begin(), rules.end());
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const Rule& a, const Rule& b) { return a.fraction() > b.fraction(); });
  QString text;
  for (std::size_t i = 0; i < contrasts.size(); ++i)
  {
    text += contrastText(i + 1, contrasts[i]);
  }
  for (const Rule& rule : sorted)
  {
    if (rule.fraction() == 0.0)
    {
      continue; // nothing to say of a rule that does not bear on this place
    }
    text += QStringLiteral("<span style='color:%1'>&#9679;</span> %2<br>")
              .arg(colorOf(rule.fraction()), useOf(rule));
    if (!rule.holds())
    {
      text += QStringLiteral("&nbsp;&nbsp;<i>%1</i><br>").arg(rule.why);
    }
  }
  setText(text);
}

} // namespace palp

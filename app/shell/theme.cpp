#include "app/shell/theme.h"

#include "app/shell/window_memory.h"

#include <QActionGroup>
#include <QApplication>
#include <QMenu>
#include <QPainter>
#include <QProxyStyle>
#include <QStyleOption>

namespace palp
{
namespace
{

// whose boxes to tick are seen in the dark, where the style's own outline is darker still
class SeenBoxes : public QProxyStyle
{
public:
  static constexpr const char* kName = "seen boxes";

  SeenBoxes()
    : QProxyStyle("fusion")
  {
    setObjectName(kName);
  }

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
    const QWidget* widget) const override
  {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element == PE_IndicatorCheckBox && isDark(option->palette))
    {
      painter->setPen(option->palette.color(QPalette::PlaceholderText));
      painter->setBrush(Qt::NoBrush);
      painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
    }
  }
};

QPalette paletteOf(const QColor& window, const QColor& base, const QColor& text,
  const QColor& disabled, const QColor& link)
{
  QPalette palette(text, window, window.lighter(150), window.darker(150), window.darker(120), text,
    text, base, window);
  palette.setColor(QPalette::AlternateBase, window);
  palette.setColor(QPalette::ToolTipBase, base);
  palette.setColor(QPalette::ToolTipText, text);
  palette.setColor(QPalette::PlaceholderText, disabled);
  palette.setColor(QPalette::Link, link);
  palette.setColor(QPalette::Highlight, QColor(48, 140, 198));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  for (const auto role : { QPalette::WindowText, QPalette::Text, QPalette::ButtonText })
  {
    palette.setColor(QPalette::Disabled, role, disabled);
  }
  return palette;
}

QPalette paletteOf(Theme theme)
{
  static const QPalette system = QApplication::palette(); // before any other was set
  switch (theme)
  {
    case Theme::Light:
      return paletteOf({ 239, 239, 239 }, Qt::white, Qt::black, { 140, 140, 140 }, Qt::blue);
    case Theme::Dark:
      return paletteOf(
        { 49, 52, 56 }, { 33, 36, 40 }, { 224, 226, 230 }, { 128, 132, 138 }, { 110, 180, 240 });
    case Theme::System:
      break;
  }
  return system;
}

} // namespace

void setTheme(Theme theme)
{
  const QPalette palette = paletteOf(theme);
  if (theme != Theme::System && QApplication::style()->objectName() != SeenBoxes::kName)
  {
    QApplication::setStyle(new SeenBoxes); // others have colors of their own
  }
  QApplication::setPalette(palette);
  WindowMemory().setTheme(static_cast<int>(theme));
}

Theme rememberedTheme()
{
  const int theme = WindowMemory().theme();
  return theme == static_cast<int>(Theme::Light) || theme == static_cast<int>(Theme::Dark)
    ? static_cast<Theme>(theme)
    : Theme::System;
}

bool isDark(const QPalette& palette)
{
  return palette.color(QPalette::WindowText).lightness() >
    palette.color(QPalette::Window).lightness();
}

void addThemes(QMenu& menu)
{
  QMenu* themes = menu.addMenu(QObject::tr("T&heme"));
  auto* group = new QActionGroup(themes);
  const Theme now = rememberedTheme();
  const auto add = [&](const QString& name, const char* id, Theme theme)
  {
    QAction* action = group->addAction(themes->addAction(name));
    action->setObjectName(id);
    action->setCheckable(true);
    action->setChecked(theme == now);
    QObject::connect(action, &QAction::triggered, themes, [theme] { setTheme(theme); });
  };
  add(QObject::tr("As the &system"), "systemTheme", Theme::System);
  add(QObject::tr("&Light"), "lightTheme", Theme::Light);
  add(QObject::tr("&Dark"), "darkTheme", Theme::Dark);
}

} // namespace palp

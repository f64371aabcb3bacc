#include "app/shell/key_sheet.h"

#include <QAction>
#include <QDialog>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QStringList>
#include <QVBoxLayout>

namespace palp
{
namespace
{

constexpr const char* kName = "keySheet";

QString plain(QString text)
{
  return text.remove('&').remove(QChar(0x2026)); // the mnemonic's mark, and the ellipsis
}

void addKeys(const QList<QAction*>& actions, std::vector<KeyEntry>& entries)
{
  for (const QAction* action : actions)
  {
    if (const QMenu* below = action->menu())
    {
      addKeys(below->actions(), entries);
    }
    else if (!action->shortcut().isEmpty())
    {
      QStringList keys;
      for (const QKeySequence& key : action->shortcuts())
      {
        keys << key.toString(QKeySequence::NativeText);
      }
      entries.push_back({ keys.join(QObject::tr(" or ")), plain(action->text()) });
    }
  }
}

} // namespace

std::vector<KeyEntry> keysOf(const QMenuBar& menus)
{
  std::vector<KeyEntry> entries;
  addKeys(menus.actions(), entries);
  return entries;
}

void showKeySheet(QWidget& window, const std::vector<KeyEntry>& mouse, const QMenuBar& menus)
{
  if (auto* shown = window.findChild<QDialog*>(kName))
  {
    shown->close();
    return;
  }
  auto* sheet = new QDialog(&window);
  sheet->setObjectName(kName);
  sheet->setWindowTitle(QObject::tr("Mouse and keys"));
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  auto* rows = new QGridLayout;
  rows->setHorizontalSpacing(24);
  rows->setVerticalSpacing(2);
  const auto add = [rows](const std::vector<KeyEntry>& entries, int column)
  {
    for (int row = 0; const KeyEntry& entry : entries)
    {
      rows->addWidget(new QLabel("<b>" + entry.keys.toHtmlEscaped() + "</b>"), row, column);
      rows->addWidget(new QLabel(entry.effect), row++, column + 1);
    }
  };
  add(mouse, 0); // beside each other, for a screen of 768 lines
  add(keysOf(menus), 2);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  QObject::connect(buttons, &QDialogButtonBox::rejected, sheet, &QDialog::reject);
  auto* column = new QVBoxLayout(sheet);
  column->addLayout(rows);
  column->addWidget(buttons);
  sheet->show();
}

} // namespace palp

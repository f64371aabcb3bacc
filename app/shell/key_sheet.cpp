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

#include <algorithm>
#include <iterator>

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
  std::vector<KeyEntry> entries = mouse;
  std::ranges::copy(keysOf(menus), std::back_inserter(entries));
  const auto half = static_cast<int>(entries.size() + 1) / 2; // beside each other, as screens are
  for (int i = 0; const KeyEntry& entry : entries)
  {
    const int column = i < half ? 0 : 2;
    rows->addWidget(new QLabel("<b>" + entry.keys.toHtmlEscaped() + "</b>"), i % half, column);
    rows->addWidget(new QLabel(entry.effect), i % half, column + 1);
    ++i;
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  QObject::connect(buttons, &QDialogButtonBox::rejected, sheet, &QDialog::reject);
  auto* column = new QVBoxLayout(sheet);
  column->addLayout(rows);
  column->addWidget(buttons);
  sheet->show();
}

} // namespace palp

#include "app/panels/press_list.h"

#include "tests/app/application.h"

#include <QAction>
#include <QTreeWidget>

#include <algorithm>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(PressList, ComparesWhereTwoPressesAreTicked)
{
  test::application();
  PressLog log;
  PressList list(log);
  const auto compares = [&]
  {
    list.refresh();
    const QList<QAction*> actions = list.actions();
    const auto compare = std::ranges::find(actions, "Compare", &QAction::text);
    return compare != actions.end() && (*compare)->isEnabled();
  };
  const auto add = [&](int id) {
    log.restore({ .id = id, .law = ForceLaw(SphereTip{ 10e-3 }, Material{ 50e3, 0.33 }) });
  };
  EXPECT_FALSE(compares()) << "there is none";
  add(1);
  EXPECT_FALSE(compares());
  add(2);
  EXPECT_TRUE(compares());
  QTreeWidgetItem* row = list.findChild<QTreeWidget*>("pressRows")->topLevelItem(0);
  row->setCheckState(0, Qt::Unchecked);
  EXPECT_FALSE(compares());
  row->setCheckState(0, Qt::Checked);
  EXPECT_TRUE(compares());
  log.remove(2);
  EXPECT_FALSE(compares());
}

} // namespace
} // namespace palp

#pragma once

#include "app/panels/panel_boxes.h"
#include "app/panels/tissue_panel.h"
#include "app/panels/tool_panel.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/app/application.h"
#include "tests/support/process.h"

#include <QComboBox>
#include <QLabel>
#include <QTest>

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace palp::test
{

using namespace units::literals;

inline constexpr const char* kFields[]{ "radius", "halfAngle", "flatRadius", "tipRadius",
  "profile" };

inline Scene sceneOf(const Tip& tip, const Material& material = { 50.0_kPa, 0.33 })
{
  Scene scene;
  scene.law = ForceLaw(tip, material);
  return scene;
}

/// The same surface of revolution, of the same kind.
inline void expectSame(const Tip& found, const Tip& expected)
{
  ASSERT_EQ(found.index(), expected.index());
  EXPECT_NEAR(baseRadius(found), baseRadius(expected), 1e-12);
  EXPECT_NEAR(flatRadius(found), flatRadius(expected), 1e-12);
  for (const double fraction : { 0.01, 0.1, 0.3, 0.6, 0.9, 1.0 })
  {
    const double radius = fraction * baseRadius(expected);
    EXPECT_NEAR(tipHeight(found, radius), tipHeight(expected, radius), 1e-12) << fraction;
  }
}

/// The panel, and a hand on its fields.
class TissuePanelTest : public ::testing::Test
{
protected:
  TissuePanelTest()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    test::application();
    use(sceneOf(SphereTip{ 10.0_mm }));
  }

  void use(const Scene& scene, bool rated = true)
  {
    panel_ = std::make_unique<TissuePanel>(scene, rated);
    panel_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(panel_.get()));
  }

  [[nodiscard]] QuantityBox& box(const char* name) const
  {
    return *panel_->findChild<QuantityBox*>(name);
  }
  [[nodiscard]] QLabel& reason(const std::string& name) const
  {
    return *panel_->findChild<QLabel*>(QString::fromStdString(name + "Reason"));
  }
  [[nodiscard]] QComboBox& list(const char* name) const
  {
    return *panel_->findChild<QComboBox*>(name);
  }
  [[nodiscard]] ToolPanel& tool() const
  {
    return *panel_->findChild<ToolPanel*>();
  }

  void type(const char* name, const char* number) const
  {
    box(name).selectAll();
    QTest::keyClick(&box(name), Qt::Key_Delete);
    QTest::keyClicks(&box(name), number);
    QTest::keyClick(&box(name), Qt::Key_Return);
  }

  [[nodiscard]] std::set<std::string> fieldsShown() const
  {
    std::set<std::string> shown;
    for (const char* name : kFields)
    {
      if (panel_->findChild<QWidget*>(name)->isVisible())
      {
        shown.insert(name);
      }
    }
    return shown;
  }

  [[nodiscard]] QString write(const char* name, const char* text) const
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return QString::fromStdString(file.string());
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<TissuePanel> panel_;
};

} // namespace palp::test

#include "pipeline/figure/orientation.h"
#include "pipeline/figure/scale_bar.h"
#include "pipeline/view/appearance.h"
#include "tests/pipeline/picture.h"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>
#include <vtkActor2DCollection.h>
#include <vtkCamera.h>

namespace palp
{
namespace
{

class Annotations : public ::testing::Test
{
protected:
  Annotations()
  {
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(400, 300);
    renderer_->SetBackground(1.0, 1.0, 1.0);
    window_->AddRenderer(renderer_);
  }

  void lookFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& up)
  {
    renderer_->GetActiveCamera()->SetPosition(eye.data());
    renderer_->GetActiveCamera()->SetViewUp(up.data());
    window_->Render();
  }

  // where a text stands, if it does
  [[nodiscard]] std::optional<Eigen::Vector2d> placeOf(const std::string& text)
  {
    vtkActor2DCollection& actors = *renderer_->GetActors2D();
    actors.InitTraversal();
    while (vtkActor2D* actor = actors.GetNextActor2D())
    {
      auto* found = vtkTextActor::SafeDownCast(actor);
      if (found != nullptr && found->GetVisibility() != 0 && text == found->GetInput())
      {
        return Eigen::Vector2d(found->GetPosition()[0], found->GetPosition()[1]);
      }
    }
    return std::nullopt;
  }

  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

// as radiology has them: from the feet, front up, the patient's right is at the left
TEST_F(Annotations, NameThePatientsSides)
{
  Orientation orientation(*renderer_);
  orientation.setPatient(true);
  lookFrom({ 0.0, 0.0, -1.0 }, { 0.0, -1.0, 0.0 });
  ASSERT_TRUE(placeOf("R") && placeOf("L") && placeOf("A") && placeOf("P"));
  EXPECT_LT(placeOf("R")->x(), placeOf("L")->x());
  EXPECT_GT(placeOf("A")->y(), placeOf("P")->y());
  EXPECT_FALSE(placeOf("S") || placeOf("I")) << "along the sight";
  // from the front, head up: the patient's left is at the right
  lookFrom({ 0.0, -1.0, 0.0 }, { 0.0, 0.0, 1.0 });
  EXPECT_LT(placeOf("R")->x(), placeOf("L")->x());
  EXPECT_GT(placeOf("S")->y(), placeOf("I")->y());
  EXPECT_FALSE(placeOf("A") || placeOf("P"));
}

TEST_F(Annotations, LettersNeverLieOnEachOther)
{
  Orientation orientation(*renderer_);
  orientation.setPatient(true);
  const std::string sides = "LRAPSI";
  constexpr int kViews = 100; // spread evenly over all directions
  for (int view = 0; view < kViews; ++view)
  {
    const double z = (2.0 * view + 1.0) / kViews - 1.0;
    const double angle = 2.399963 * view; // [rad] the golden one
    const double radius = std::sqrt(1.0 - z * z);
    lookFrom({ radius * std::cos(angle), radius * std::sin(angle), z }, { 0.1, 0.2, 1.0 });
    std::vector<Eigen::Vector2d> places;
    for (const char side : sides)
    {
      const std::optional<Eigen::Vector2d> at = placeOf(std::string(1, side));
      for (const Eigen::Vector2d& other : places)
      {
        EXPECT_TRUE(!at || (*at - other).norm() > 12.0) << side << " in view " << view;
      }
      if (at)
      {
        places.push_back(*at);
      }
    }
    EXPECT_GE(places.size(), 3U) << "view " << view;
  }
}

TEST_F(Annotations, NameOnlyAxesWhereNobodyKnowsThePatient)
{
  Orientation orientation(*renderer_);
  lookFrom({ 0.5, -0.7, 0.4 }, { 0.0, 0.0, 1.0 });
  EXPECT_TRUE(placeOf("x") && placeOf("y") && placeOf("z"));
  EXPECT_FALSE(placeOf("R") || placeOf("L"));
  orientation.setVisible(false);
  window_->Render();
  EXPECT_FALSE(placeOf("x"));
}

// or as far away as the contact, here off the middle of the picture
TEST_F(Annotations, BarIsAsLongAsItSaysWhereTheEyeLooks)
{
  ScaleBar bar(*renderer_);
  bar.setVisible(true);
  for (const auto& [distance, nearer] :
    { std::pair(0.1, 0.0), { 0.5, 0.0 }, { 2.0, 0.0 }, { 0.5, 0.25 }, { 0.5, -0.2 } })
  {
    lookFrom({ 0.0, -distance, 0.0 }, { 0.0, 0.0, 1.0 });
    bar.setPlace(
      nearer == 0.0 ? std::nullopt : std::optional(Eigen::Vector3d(0.03, -nearer, 0.01)));
    const auto image = test::imageOf(*window_);
    const auto pixelOf = [&](double x)
    {
      renderer_->SetWorldPoint(x, -nearer, 0.0, 1.0);
      renderer_->WorldToDisplay();
      return renderer_->GetDisplayPoint()[0];
    };
    const double expected = pixelOf(bar.length()) - pixelOf(0.0);
    int drawn = 0;
    for (int y = 20; y < 29; ++y)
    {
      int dark = 0;
      for (int x = 0; x < 400; ++x)
      {
        dark += image->GetScalarComponentAsDouble(x, y, 0, 1) < 128.0 ? 1 : 0;
      }
      drawn = std::max(drawn, dark);
    }
    EXPECT_NEAR(drawn, expected, 3.0) << distance;
    EXPECT_GT(drawn, 60);
    EXPECT_LT(drawn, 170);
    EXPECT_TRUE(placeOf(appearance::fixedText(1000.0 * bar.length(), 0) + " mm")) << distance;
  }
}

} // namespace
} // namespace palp

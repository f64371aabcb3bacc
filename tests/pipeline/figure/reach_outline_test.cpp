#include "pipeline/figure/reach_outline.h"

#include <gtest/gtest.h>
#include <vtkActorCollection.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

TEST(ReachOutline, IsAsLargeAsTheWorkspaceAndWhereItIs)
{
  vtkNew<vtkRenderer> renderer;
  ReachOutline outline(*renderer);
  EXPECT_FALSE(outline.show({ 1.0, 2.0, 3.0 }, 0.0));
  EXPECT_EQ(renderer->GetActors()->GetNumberOfItems(), 0) << "no device, no actor";
  EXPECT_TRUE(outline.show({ 0.1, 0.2, -0.3 }, 0.04));
  EXPECT_FALSE(outline.show({ 0.1, 0.2, -0.3 }, 0.04));
  vtkActor* actor = renderer->GetActors()->GetLastActor();
  ASSERT_NE(actor, nullptr);
  const std::array expected{ 0.06, 0.14, 0.16, 0.24, -0.34, -0.26 };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(actor->GetBounds()[i], expected[i], 1e-4) << i; // of 96 sides
  }
  EXPECT_FALSE(actor->GetUseBounds()) << "the view is fitted to the body alone";
  EXPECT_TRUE(outline.show({ 0.2, 0.2, -0.3 }, 0.04));
  EXPECT_NEAR(actor->GetBounds()[0], 0.16, 1e-4);
  EXPECT_TRUE(outline.show({ 0.2, 0.2, -0.3 }, 0.0));
  EXPECT_FALSE(actor->GetVisibility());
}

} // namespace
} // namespace palp

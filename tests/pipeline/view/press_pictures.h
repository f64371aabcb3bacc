#pragma once

#include "haptics/units.h"
#include "pipeline/view/press_view.h"
#include "tests/pipeline/picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

namespace palp::test
{

using namespace units::literals;

/// A surface, and where it is pressed.
struct Specimen
{
  vtkSmartPointer<vtkPolyData> surface;
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
};

inline Specimen liver()
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(PALP_SHARE "/meshes/liver.vtp");
  vtkNew<vtkTransform> toMeters;
  const double meter = units::fromMillimeters(1.0);
  toMeters->Scale(meter, meter, meter);
  vtkNew<vtkTransformPolyDataFilter> scaled;
  scaled->SetTransform(toMeters);
  scaled->SetInputConnection(reader->GetOutputPort());
  scaled->Update();
  // the highest point
  Specimen body{ scaled->GetOutput(), { 0.0, 0.0, -1.0 }, Eigen::Vector3d::UnitZ() };
  for (vtkIdType i = 0; i < body.surface->GetNumberOfPoints(); ++i)
  {
    double point[3];
    body.surface->GetPoint(i, point);
    if (point[2] > body.position.z())
    {
      body.position = Eigen::Vector3d(point[0], point[1], point[2]);
    }
  }
  return body;
}

inline Specimen ball()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(50.0_mm);
  source->SetThetaResolution(120);
  source->SetPhiResolution(90);
  source->Update();
  return { source->GetOutput(), { 0.0, 0.0, 50.0_mm }, Eigen::Vector3d::UnitZ() };
}

inline Specimen block()
{
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(100.0_mm);
  cube->SetYLength(100.0_mm);
  cube->SetZLength(50.0_mm);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkLinearSubdivisionFilter> finer;
  finer->SetInputConnection(triangles->GetOutputPort());
  finer->SetNumberOfSubdivisions(6);
  finer->Update();
  return { finer->GetOutput(), { 0.0, 0.0, 25.0_mm }, Eigen::Vector3d::UnitZ() };
}

inline const Tip kSphere = SphereTip{ 10.0_mm };
inline const Tip kCone = ConeTip{ 45.0_deg, 10.0_mm };
inline const Tip kSmall = SphereTip{ 3.0_mm };

inline Sample pressed(const Specimen& body, const Tip& tip, double depth)
{
  const ForceLaw law(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 });
  Sample sample;
  sample.contact = { .depth = depth, .normal = body.normal, .center = body.position };
  sample.pose = { .apex = body.position - depth * body.normal, .axis = -body.normal };
  sample.response = law({ .depth = depth });
  return sample;
}

/// An off-screen window that shows a press.
struct View
{
  explicit View(const Specimen& body, const Tip& tip)
    : view(*renderer)
    , tool(tip)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(480, 360);
    window->AddRenderer(renderer);
    view.setSurface(body.surface);
    view.setTip(tip);
    view.setLaw(ForceLaw(tip, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 }));
    view.setExtents(ExtentTable({ { 1.0_mm, 3.5_mm, 0.2, 3.0_mm }, { 5.0_mm, 18.4_mm, 2.9, 7.0_mm },
      { 10.0_mm, 30.0_mm, 8.0, 10.0_mm } }));
  }

  vtkSmartPointer<vtkImageData> picture(const Specimen& body, const Sample& sample)
  {
    view.show(sample);
    lookAt(body);
    return imageOf(*window);
  }

  // 50 degrees from the normal, which shows into the dent and along the arrow; from the front, so
  // that the view does not roll with the normal
  void lookAt(const Specimen& body)
  {
    const double base = baseRadius(tool);
    const double diagonal = body.surface->GetLength();
    const double height =
      std::max(9.0 * base, std::clamp(14.0 * base, 0.2 * diagonal, 0.45 * diagonal));
    const double distance = 0.5 * height / std::tan(15.0_deg);
    Eigen::Vector3d side = -Eigen::Vector3d::UnitY() + body.normal.y() * body.normal;
    side = side.norm() > 0.3 ? side.normalized() : body.normal.unitOrthogonal();
    const Eigen::Vector3d towards = std::cos(50.0_deg) * body.normal + std::sin(50.0_deg) * side;
    const Eigen::Vector3d focus = body.position + 0.12 * height * body.normal;
    const Eigen::Vector3d eye = focus + distance * towards;
    vtkCamera& camera = *renderer->GetActiveCamera();
    camera.SetFocalPoint(focus.data());
    camera.SetPosition(eye.data());
    camera.SetViewUp(body.normal.data());
    renderer->ResetCameraClippingRange();
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  PressView view;
  Tip tool;
};

inline void expectBaseline(vtkImageData& image, const std::string& name)
{
  const Difference difference = differenceFromBaseline(image, name);
  EXPECT_LT(difference.mean, 1.5) << name;
  EXPECT_LT(difference.changed, 0.01) << name;
}

} // namespace palp::test

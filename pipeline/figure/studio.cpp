#include "pipeline/figure/studio.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>

namespace palp
{
namespace
{

constexpr int kWidth = 64; // of the panorama, whose height is half of it
constexpr int kHeight = kWidth / 2;
constexpr double kLamps = 2.5; // times what they are without walls that send light back

// brightness by height, from the floor at 0 to the ceiling at 1
float brightness(double height)
{
  constexpr double kFloor = 0.02;
  constexpr double kCeiling = 0.22;
  return static_cast<float>(std::lerp(kFloor, kCeiling, height * height * (3.0 - 2.0 * height)));
}

// whether they are to be found on a color bar, as of what has an ambient part
bool keepsColors(vtkActor& actor)
{
  vtkMapper* mapper = actor.GetMapper();
  return mapper != nullptr && mapper->GetScalarVisibility() != 0 &&
    mapper->GetArrayName() != nullptr && actor.GetProperty()->GetAmbient() > 0.0;
}

// a change makes the shader anew
void replaceOnce(vtkActor& actor, const std::string& tag, const std::string& code)
{
  vtkShaderProperty& shader = *actor.GetShaderProperty();
  std::string name;
  std::string value;
  bool first = false;
  bool all = false;
  if (shader.GetNumberOfShaderReplacements() > 0)
  {
    shader.GetNthShaderReplacement(0, name, first, value, all);
  }
  if (name != tag)
  {
    shader.ClearAllFragmentShaderReplacements();
    shader.AddFragmentShaderReplacement(tag, true, tag + '\n' + code, false);
  }
}

void makePhysical(vtkActor& actor)
{
  constexpr double kRoughness = 0.35; // wet
  vtkProperty& property = *actor.GetProperty();
  property.SetInterpolationToPBR();
  property.SetMetallic(0.0);
  property.SetRoughness(kRoughness);
  // it takes colors as shares of light, and we have them as a screen shows them
  keepsColors(actor)
    ? replaceOnce(actor, "//VTK::Light::Impl",
        "  gl_FragData[0].rgb = diffuseColor / diffuseIntensity * (0.7 + 0.3 * "
        "abs(normalVCVSOutput.z));\n")
    : replaceOnce(actor, "//VTK::Color::Impl", "  diffuseColor = pow(diffuseColor, vec3(2.2));\n");
}

template <typename Use>
void eachLit(vtkRenderer& renderer, Use use)
{
  vtkActorCollection& actors = *renderer.GetActors();
  actors.InitTraversal();
  while (vtkActor* actor = actors.GetNextActor())
  {
    actor->GetProperty()->GetLighting() ? use(*actor) : void();
  }
}

void brighten(vtkRenderer& renderer, double times)
{
  vtkLightCollection& lamps = *renderer.GetLights();
  lamps.InitTraversal();
  while (vtkLight* lamp = lamps.GetNextItem())
  {
    lamp->SetIntensity(times * lamp->GetIntensity());
  }
}

} // namespace

void addStudio(vtkRenderer& renderer)
{
  vtkNew<vtkImageData> panorama;
  panorama->SetDimensions(kWidth, kHeight, 1);
  panorama->AllocateScalars(VTK_FLOAT, 3);
  for (int y = 0; y < kHeight; ++y)
  {
    auto* row = static_cast<float*>(panorama->GetScalarPointer(0, y, 0));
    std::fill_n(row, 3 * kWidth, brightness((y + 0.5) / kHeight));
  }
  vtkNew<vtkTexture> texture;
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  texture->SetInputDataObject(panorama);
  renderer.SetEnvironmentTexture(texture, false);
  renderer.UseImageBasedLightingOn();
  brighten(renderer, kLamps);
}

void makePhysical(vtkRenderer& renderer)
{
  renderer.SetEnvironmentUp(renderer.GetActiveCamera()->GetViewUp());
  eachLit(renderer, [](vtkActor& actor) { makePhysical(actor); });
}

void removeStudio(vtkRenderer& renderer)
{
  renderer.UseImageBasedLightingOff();
  renderer.SetEnvironmentTexture(nullptr);
  brighten(renderer, 1.0 / kLamps);
  eachLit(renderer,
    [](vtkActor& actor)
    {
      actor.GetProperty()->SetInterpolationToGouraud();
      actor.GetShaderProperty()->ClearAllFragmentShaderReplacements();
    });
}

} // namespace palp

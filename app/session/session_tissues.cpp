// What a session feels: tool, tissue and law of one body, or of its organs.

#include "app/scene/scene_text.h"
#include "app/session/session.h"
#include "haptics/error.h"

#include <utility>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// all of organs but how they are seen
std::string feltText(const std::vector<MeshSource>& meshes, std::vector<OrganPlan> organs)
{
  for (OrganPlan& organ : organs)
  {
    organ.color = OrganColor{};
    organ.role = organ.isFelt() ? OrganRole::Press : OrganRole::Hide;
  }
  return sceneText({ .meshes = meshes, .organs = std::move(organs) }, "/");
}

// the tool and the kind of law of another tissue; what only the corrected law knows goes with it
void takeLaw(TissueOptions& tissue, const ForceLaw& law)
{
  const LawSettings& settings = law.settings();
  tissue.tip = law.tip();
  tissue.options.mode = settings.mode;
  tissue.options.base = settings.base;
  tissue.options.constitution = settings.constitution;
  if (settings.mode != LawMode::Corrected)
  {
    tissue.options.coatings = {};
    tissue.options.relaxation = {};
    tissue.options.friction = 0.0;
  }
}

} // namespace

// to be changed
Scene Session::nextScene() const
{
  Scene scene = recording_.scene;
  ++scene.version;
  return scene;
}

void Session::use(Scene scene)
{
  Calibration calibration = loadCalibration(plan_.press, scene); // may throw
  endRecording(body_);
  calibration_ = std::move(calibration);
  recording_.scene = std::move(scene);
  tellScene();
  recordedFrom_ = newest().time + kForgiving;
}

std::function<Session::Felt()> Session::feltWith(
  const ForceLaw& law, ContactRule rule, double damping, std::size_t organ) const
{
  if (organs().empty())
  {
    Scene scene = recording_.scene;
    scene.law = law;
    scene.rule = rule;
    scene.damping = damping;
    return [scene, body = body_]
    {
      Felt felt{ scene, {} };
      feelTissue(*felt.scene, body);
      return felt;
    };
  }
  std::vector<OrganPlan> changed = organs();
  for (OrganPlan& each : changed)
  {
    takeLaw(each.press.tissue, law);
    each.press.contact = rule;
  }
  changed[organ].press.tissue = optionsOf(law, recording_.rated);
  changed[organ].press.damping = damping;
  return feltWith(std::move(changed));
}

std::function<Session::Felt()> Session::feltWith(std::vector<OrganPlan> changed) const
{
  if (feltOrgans(changed).empty())
  {
    throw Error(ErrorCode::BadValue, "no organ would be felt; let one of them be pressed");
  }
  if (feltText(body_.sources, changed) == feltText(body_.sources, organs()))
  {
    return [changed = std::move(changed)] { return Felt{ std::nullopt, changed }; };
  }
  return [changed = std::move(changed), scene = recording_.scene, body = body_]
  {
    Felt felt{ scene, changed };
    felt.scene->rule = changed.front().press.contact;
    setTissues(*felt.scene, changed);
    setFelt(*felt.scene, body, changed);
    return felt;
  };
}

void Session::setTissue(Felt felt)
{
  if (felt.scene)
  {
    Scene scene = nextScene();
    felt.scene->version = scene.version;
    felt.scene->armed = scene.armed; // may have changed since
    felt.scene->forceLimit = scene.forceLimit;
    use(*std::move(felt.scene));
  }
  recording_.organs = std::move(felt.organs);
}

} // namespace palp

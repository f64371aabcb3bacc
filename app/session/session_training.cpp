// A session that hides nodules, until what was found is graded.

#include "app/session/session.h"
#include "haptics/error.h"

#include <utility>
#include <vtkPolyData.h>

namespace palp
{

void Session::train(const TrainingPlan& training)
{
  if (!organs().empty())
  {
    throw Error(ErrorCode::BadValue,
      "training: hides nodules in one body; open the file of an organ by itself");
  }
  if (body_.stiffness)
  {
    throw Error(ErrorCode::BadValue,
      "training: hides nodules in tissue that is even; open the body without its map of stiffness");
  }
  TissueOptions tissue = optionsOf(recording_.scene.law, false);
  tissue.options.mode = LawMode::Corrected; // which alone knows nodules
  Scene scene = nextScene();
  scene.law = tissue.law();
  SceneBody body = body_;
  for (MeshSource& source : body.sources)
  {
    source.nodules.clear(); // of a search before
  }
  hideIn(body, scene.law, training);
  feelTissue(scene, body);
  use(std::move(scene));
  calibration_.style.extent = nullptr; // by which a dent would give away what lies below it
  body_ = std::move(body);
  recording_.rated = false;
}

void Session::finishTraining(std::vector<double> marks)
{
  body_.training->marks = std::move(marks);
  use(nextScene());
  revealNodules(body_);
  recording_.rated = plan_.validity;
}

} // namespace palp

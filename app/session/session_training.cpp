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
  scene.nodules = feltNodules(body, scene.law);
  use(std::move(scene));
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

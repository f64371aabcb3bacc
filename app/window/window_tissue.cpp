// What is felt: tool, tissue and law, as the panel asks for them.

#include "app/organs/organ_list.h"
#include "app/panels/tissue_panel.h"
#include "app/shell/change.h"
#include "app/window/window.h"

#include <utility>

namespace palp
{

void Window::applyTissue()
{
  attempt(
    [this]
    {
      const ForceLaw law = panel_->law();
      endReview();
      if (useFelt(session_.feltWith(
            law, panel_->rule(), panel_->damping(), organs_ ? organs_->chosen() : 0)))
      {
        showOrgans();
        clearCharts(); // as the recording
        sayWhatIsKept();
      }
    });
  panel_->setScene(tissueInUse()); // what was refused is not in use
}

// false: canceled
bool Window::useFelt(const std::function<Session::Felt()>& work)
{
  std::optional<Session::Felt> felt =
    inBackground<Session::Felt>(tr("Preparing what is felt"), work);
  if (felt)
  {
    takeSamples();
    session_.setTissue(*std::move(felt));
  }
  return felt.has_value();
}

// a change ends a recording
void Window::sayWhatIsKept()
{
  const std::size_t takes = session_.earlier().size();
  if (takes > takesKept_)
  {
    const std::vector<Sample>& samples = session_.earlier().back().recording.samples;
    say(tr("A new recording begins. The one before, %1 s, is kept: Export data writes it, too")
          .arg(samples.back().time - samples.front().time, 0, 'f', 1));
  }
  takesKept_ = takes;
}

// of the panel, by the user; false: it stays as it was
bool Window::changeTissue()
{
  Scene before = session_.scene();
  const std::vector<OrganPlan> organs = session_.organs();
  applyTissue();
  Scene after = session_.scene();
  if (after.version == before.version)
  {
    return false;
  }
  if (!organs.empty())
  {
    keepUndo(organs);
    return true;
  }
  const auto use = [this](Scene scene)
  {
    scene.surface = nullptr; // whatever is open then
    scene.nodules = nullptr;
    return [this, scene]
    {
      panel_->setScene(scene);
      applyTissue();
    };
  };
  undo_.push(new Change(tr("tool, tissue or law"), use(std::move(before)), use(std::move(after))));
  return true;
}

} // namespace palp

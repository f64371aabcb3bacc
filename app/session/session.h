#pragma once

#include "app/input/scene_plan.h"
#include "app/press/body.h"
#include "app/press/calibration.h"
#include "app/press/press_log.h"
#include "app/press/recording.h"
#include "app/session/hand.h"
#include "app/session/sample_readers.h"
#include "haptics/devices/device.h"
#include "haptics/devices/simulated/guided_tool.h"
#include "haptics/servo/servo.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

class Autosave;
class BuildTrace;
class ScriptedDevice;
struct ExportFolder;

/// A live press: body, tissue, one hand or two with their devices and servo threads, the recording.
///
/// What is told of a tool without naming a hand is of the first: presses, training and curves are
/// its own. The only writer of the scene. Main thread only.
class Session
{
public:
  static constexpr double kClearance = 0.015; ///< of a hovering tool above the surface [m]

  /// @param stop    an emergency stop for signal handlers; outlives this object, or null
  /// @throws Error  as loadBody, loadCalibration, useDevice
  Session(ScenePlan plan, BuildTrace& trace, const std::atomic<bool>* stop = nullptr);

  /// What it was made of at the start.
  [[nodiscard]] const ScenePlan& plan() const noexcept
  {
    return plan_;
  }

  /// Replaces the body, or all organs; the device stays, and of one body the tissue. Where the
  /// stiffness of the new one differs from place to place, the law is then the corrected one, which
  /// alone feels it.
  /// @param organs  that the body is of, with their tissues, one tool and one kind of law; none:
  /// one
  /// @throws Error  as feelTissue, useDevice; the old body then stays
  void open(SceneBody body, std::vector<OrganPlan> organs = {});

  /// Hides nodules in the only body, under the corrected law, and begins a recording which neither
  /// rates a sample nor is saved before it is graded.
  /// @param training  without marks
  /// @throws Error    BadValue: several organs; as hideNodules, feelTissue; everything then stays
  void train(const TrainingPlan& training);

  /// Ends such a recording, the last of earlier() where anything was touched; its nodules are then
  /// known.
  void finishTraining(std::vector<double> marks);

  /// What the tool would feel.
  struct Felt
  {
    std::optional<Scene> scene; ///< none: what it feels now
    std::vector<OrganPlan> organs;
  };

  /// What the tool would feel of another tissue: work for any thread, seconds of it where the
  /// stiffness differs from place to place, which throws as TissueOptions::law and feelTissue.
  ///
  /// @param organ  whose tissue it is, the tool and the kind of law being those of all; in the
  /// order
  ///               of organs()
  [[nodiscard]] std::function<Felt()> feltWith(
    const ForceLaw& law, ContactRule rule, double damping, std::size_t organ = 0) const;

  /// The same of the organs with other roles, colors and tissues.
  /// @throws Error  BadValue: none would be felt
  [[nodiscard]] std::function<Felt()> feltWith(std::vector<OrganPlan> organs) const;

  /// A recording begins where something else is felt, as its header tells of one tool and tissue;
  /// see earlier(). What the user wishes of the device stays.
  /// @throws Error  as loadCalibration; everything then stays
  void setTissue(Felt felt);

  /// Of the scene, in its order; empty where there is one body.
  [[nodiscard]] const std::vector<OrganPlan>& organs() const noexcept
  {
    return recording_.organs;
  }

  /// A recording begins.
  /// @throws Error  BadValue, BadFile, NoDevice; the old device then stays, or, where it was asked
  ///                for again and is gone, the mouse takes its place
  void useDevice(const DeviceChoice& choice);

  /// The same with a device of the caller's.
  void useDevice(const DeviceChoice& choice, std::unique_ptr<Device> device);

  /// Gives a second hand its device, or another one, or takes it away. A recording begins.
  /// @throws Error  as useDevice, checkHands; the old one then stays, or where it was asked for
  ///                again and is gone, there is one hand
  void useSecond(const std::optional<DeviceChoice>& choice);

  /// The same with a device of the caller's.
  void useSecond(const DeviceChoice& choice, std::unique_ptr<Device> device);

  [[nodiscard]] bool hasSecond() const noexcept
  {
    return hands_.size() > 1;
  }

  /// Of the second hand; null where there is one.
  [[nodiscard]] const Sample* newestOfSecond() noexcept
  {
    return hasSecond() ? &hands_.back().servo->newest() : nullptr;
  }

  /// Turns the device so that its right, away from the user and up are those of a view, and puts it
  /// above the body as it is seen there. Its force is off until armed. A recording begins.
  /// @param seen  columns right, away, up in the coordinates of the body, orthonormal
  /// @return      false, and nothing else: it has no place of its own
  bool turnDevice(const Eigen::Matrix3d& seen);

  /// Moves the tool so much further than the hand; else as turnDevice.
  bool scaleDevice(double scale);
  [[nodiscard]] double scale() const noexcept
  {
    return plan_.placement.scale;
  }

  /// Whether any device has a place of its own.
  [[nodiscard]] bool isPlaced() const;

  /// Holds the tools of devices, without force, while their hands go elsewhere: a clutch for hands
  /// that have no button free.
  void holdTools(bool held);

  /// How far the device reaches now [m]; a radius of 0: no bound.
  struct Reach
  {
    Eigen::Vector3d center;
    double radius;
  };
  [[nodiscard]] Reach reach()
  {
    const DeviceLimits limits = first().device->limits();
    return { limits.workspaceCenter + newest().moved, limits.workspaceRadius };
  }

  /// Lets the tool lag behind a device that no hand can feel, the more the stiffer the tissue is
  /// there; the reference is the tissue in use now. See LaggingTool. A recording begins.
  /// @throws Error  as useDevice
  void lag(bool lags);
  [[nodiscard]] bool lags() const noexcept
  {
    return first().lagging != nullptr;
  }

  /// Names that parseDevice takes: of the devices that move by themselves only those that are there
  /// and may be used.
  [[nodiscard]] static std::vector<std::string> devices();

  /// Whether the user wants to feel force; off for every device but a simulated hand until asked.
  /// A fault takes the wish back, of either hand for both.
  void arm(bool armed);

  /// Zero force at once and until taken back; then the device must be armed again.
  void stop(bool stopped);

  /// False for devices that move the tool themselves.
  [[nodiscard]] bool isLed() const noexcept
  {
    return first().guided != nullptr;
  }

  /// The device that plays a path; null for any other.
  [[nodiscard]] ScriptedDevice* scripted() const noexcept;

  /// False where no hand can feel anything.
  [[nodiscard]] bool rendersForce() const;
  /// The same of one hand.
  /// @param hand  0, or 1 where there is a second
  [[nodiscard]] bool rendersForce(std::size_t hand) const
  {
    return hands_[hand].device->limits().rendersForce;
  }
  /// What the devices can render without trembling [N/m]; infinite where no hand can feel it.
  [[nodiscard]] double stableStiffness() const;
  /// Beyond it a force is shortened, that of a weaker device first [N].
  [[nodiscard]] double largestForce() const;
  [[nodiscard]] bool armed() const noexcept
  {
    return recording_.scene.armed;
  }

  /// Moves the tool of mouse and hand; other devices move themselves.
  void aim(const PressTarget& target);

  /// Fetches what the servo thread did since the last call.
  /// @param each  called for each new sample of the first hand, in order
  void update(const std::function<void(const Sample&)>& each);

  [[nodiscard]] const Sample& newest() noexcept
  {
    return first().servo->newest();
  }
  /// Whether a sample is of the tool, the tissue and the organs in use, not of those before.
  [[nodiscard]] bool isCurrent(const Sample& sample) const noexcept
  {
    return sample.time >= recordedFrom_ && sample.organ < organCount(recording_.scene);
  }
  [[nodiscard]] const Timing& timing() const noexcept
  {
    return first().servo->timing();
  }
  [[nodiscard]] const std::string& schedule() const noexcept
  {
    return first().servo->schedule();
  }
  [[nodiscard]] const SceneBody& body() const noexcept
  {
    return body_;
  }
  [[nodiscard]] const Calibration& calibration() const noexcept
  {
    return calibration_;
  }

  /// The last ten minutes whole, see bound(); without samples where the plan has no curves to draw
  /// of them.
  [[nodiscard]] const Recording& recording() const noexcept
  {
    closeGap(recording_);
    return recording_;
  }

  /// Of the recording, which takes longer to be asked for while it is bounded.
  [[nodiscard]] const Scene& scene() const noexcept
  {
    return recording_.scene;
  }
  [[nodiscard]] bool isThinned() const noexcept
  {
    return recording_.thinned > 0;
  }

  /// The samples of a recording of this session, to be copied on another thread while it goes on.
  [[nodiscard]] std::function<std::vector<Sample>()> samplesOf(const Recording& recording) const
  {
    return readers_.of(recording, &recording == &this->recording());
  }

  /// A recording that another body, tool, tissue or device ended, with what it was made on.
  struct Take
  {
    SceneBody body;
    Recording recording;
    Calibration calibration;
    std::optional<CameraPlace> seenFrom{}; ///< as its body was left for another; none: it is open
  };

  /// Those with a press in them, oldest first; thinned where together they hold more than ten
  /// minutes, and the oldest gone where they still hold more than twenty.
  [[nodiscard]] const std::vector<Take>& earlier() const noexcept
  {
    return earlier_;
  }

  /// Notes from where a body was seen that is open no longer.
  void noteSeen(const CameraPlace& place);

  /// Those of all recordings, also of the ones that are gone.
  [[nodiscard]] PressLog& presses() noexcept
  {
    return presses_;
  }

  /// Saves each press from now on as it ends.
  /// @param autosave  outlives the session; null: no longer
  void saveTo(Autosave* autosave) noexcept
  {
    autosave_ = autosave;
  }

  /// What presses once more what an export holds, as a recording on a body of its own: work for any
  /// thread, which throws as checkInputs, loadBody, playInto.
  [[nodiscard]] std::function<Take()> takeOf(const ExportFolder& made) const;

  /// Adds an earlier recording.
  /// @return  the presses that were found in it
  std::size_t add(Take take);

private:
  static constexpr double kForgiving = 0.05; // until the servo has heard of an order, at most [s]

  [[nodiscard]] Scene nextScene() const;
  // a law in the corrected mode, which alone feels what is inside
  [[nodiscard]] ForceLaw knowing(const ForceLaw& law) const;
  void use(Scene scene);
  void drain(const SceneBody& body, const std::function<void(const Sample&)>& each);
  [[nodiscard]] Hand& first() noexcept
  {
    return hands_.front();
  }
  [[nodiscard]] const Hand& first() const noexcept
  {
    return hands_.front();
  }
  void record(Hand& hand, const Sample& sample, const std::function<void(const Sample&)>& each);
  void disarmAtFault();
  void endRecording(const SceneBody& body);
  [[nodiscard]] std::optional<SceneBody> knownBody(const ScenePlan& plan) const;
  void boundAll();
  void save(const SceneBody& body, std::optional<Recording> press);
  [[nodiscard]] std::unique_ptr<Device> makeDevice(std::size_t hand, const DeviceChoice& choice);
  void keepHolding();
  bool placeDevices(const Eigen::Matrix3d& facing, double scale);
  void hold(std::size_t hand, const DeviceChoice& choice, std::unique_ptr<Device> device);
  void give(std::size_t hand, const DeviceChoice& choice, std::unique_ptr<Device> device);
  void stopServos();
  void startServos();
  void tellScene();
  [[nodiscard]] ToolPose restingPose(const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ()) const;
  [[nodiscard]] DevicePlacement placement(std::size_t hand) const;

  ScenePlan plan_;
  ServoOptions servoOptions_;
  Eigen::Matrix3d facing_ = Eigen::Matrix3d::Identity(); // of devices, in those of the body
  SceneBody body_;
  mutable Recording recording_; // its scene is the one that the servo thread has
  Calibration calibration_;
  double armedAt_ = 0.0;      // time of the servo from which on a fault is a new one [s]
  double recordedFrom_ = 0.0; // and from which on a sample is of the tool and tissue in use [s]
  std::vector<Take> earlier_;
  SampleReaders readers_; // of all recordings
  PressLog presses_;
  Autosave* autosave_ = nullptr;
  std::optional<Material> lagReference_{};         // none: no tool lags
  std::atomic<bool> fault_ = false;                // of a hand, which disarms both
  std::vector<Hand> hands_ = std::vector<Hand>(1); // one or two; last: servos use all above
};

} // namespace palp

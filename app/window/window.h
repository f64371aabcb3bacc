#pragma once

#include "app/map/map_work.h"
#include "app/places/met_organ.h"
#include "app/plots/press_figure.h"
#include "app/plots/press_plots.h"
#include "app/press/review.h"
#include "app/session/pointer_tool.h"
#include "app/session/session.h"
#include "app/shell/background.h"
#include "app/shell/message_bar.h"
#include "app/shell/saves.h"
#include "app/shell/window_memory.h"
#include "app/sound/force_sound.h"
#include "app/train/panel/search.h"
#include "app/window/pictured.h"
#include "haptics/force/validity.h"
#include "pipeline/charts/force_charts.h"
#include "pipeline/figure/balls.h"
#include "pipeline/figure/orientation.h"
#include "pipeline/figure/other_hand.h"
#include "pipeline/figure/reach_outline.h"
#include "pipeline/figure/realism.h"
#include "pipeline/figure/scale_bar.h"
#include "pipeline/figure/surroundings.h"

#include <QElapsedTimer>
#include <QMainWindow>
#include <QUndoStack>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

class QLabel;
class QTimer;
class QVTKOpenGLNativeWidget;
class vtkGenericOpenGLRenderWindow;
class vtkPalpPressStyle;
class vtkRenderer;

namespace palp
{

struct ExportFolder;
struct Exported;
struct FileOrgan;
struct FileOrgans;
class DevicePanel;
class DiagnosticsPanel;
class OrganList;
class PlayBar;
class TrainingPanel;
class PressBar;
class PressList;
class SupportPainting;
class SurfaceCheck;
class ChartPanel;
class PlotPanel;
class ValidityPanel;
class TissuePanel;

/// The window: the body in 3-D, tool and tissue at the left, live curves at the right. Draws what
/// the servo thread publishes and never holds that thread up.
class Window : public QMainWindow
{
  Q_OBJECT

public:
  /// @param session  outlives the window
  Window(Session& session, BuildTrace& trace);
  ~Window() override;

  /// Saves each press as it ends, and offers those that a program left which was killed.
  /// @param autosave  outlives the window and its session
  void saveTo(Autosave& autosave);

  /// Says how to begin, where nobody has yet.
  void greet();
  // What the menus do, once a file is chosen; a failure becomes a message, and false.
  bool openFile(const QString& file, UnitChoice unit = {}); // a body; asks for what is not told
  bool openFiles(const QStringList& files);                 // of any kind that is read, or folders
  bool loadPresses(const QString& folder, bool isAgain = false); // of an export; once, or asked
  bool saveScreenshot(const QString& file);
  // none: of what is shown
  bool saveFigure(const QString& file, ImageSize size, const FigureLook& look,
    const std::optional<Sample>& moment = std::nullopt);
  bool saveReplay(const QString& file);    // a movie, which gets the ending of what it is
  bool saveTurntable(const QString& file); // likewise
  bool savePlots(const QString& file, std::optional<ImageSize> size = std::nullopt);
  bool saveCurves(const QString& file);
  bool saveChart(std::size_t chart, const QString& file, ImageSize size); // of charts_, counted
  bool saveSheet(const QString& directory);  // of the search that was graded last
  bool solveOrgan(const QString& file);      // on the supports of the panel
  bool exportData(const QString& directory); // asks in the bar where files would be replaced

protected:
  void changeEvent(QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  void makeView();
  void makeDocks();
  void makeCharts();
  ChartPanel* makeChartPanel(std::size_t chart);
  void makeDevicePanel();
  void makePlots(bool shown);
  void showPlots(const QString& page);
  void offerDevices();
  void makeFileMenu();
  void makeEditMenu();
  void makeDeviceMenu();
  void makeViewMenu();
  void addStandardViews(QMenu& menu);
  void addBodyLooks(QMenu& menu);
  void addToolLooks(QMenu& menu);
  void addRealism(QMenu& menu);
  void chooseRealism();
  void tellCoarse();
  void setRealistic(bool on);
  void addMarks(QMenu& menu);
  void addOpening(QMenu& file);
  void addRecentFiles(QMenu& menu);
  bool openBody(const ScenePlan& plan);
  bool openLabels(const MeshSource& image, std::vector<FileOrgan> labels);
  bool openAsked(MeshSource source);
  [[nodiscard]] FileOrgans labelsIn(const QString& file);
  void openOther(const QString& file);
  void openScene(const QString& file);
  void openPlaces(const QString& file);
  void openOrgan(const QString& file);
  void pressQueued();
  void openRecent(const QString& file);
  void makeHelpMenu();
  void makeToolBar();
  void showBody();
  // of a scene with several organs
  void makeOrganList();
  void showOrgans();
  void chooseTouched();
  bool useOrgans(const std::vector<OrganPlan>& organs);
  void changeOrgans(const std::vector<OrganPlan>& organs);
  void keepUndo(const std::vector<OrganPlan>& before);
  [[nodiscard]] Scene tissueInUse() const;
  [[nodiscard]] const Scene& organShown() const;
  [[nodiscard]] const Calibration& calibrationShown() const;
  // the pointer as a tool, in display pixels
  void makePointer();
  void makePressBar();
  bool pressAtPlace();

  // the map of stiffness
  void addMap(QMenu& edit);
  [[nodiscard]] std::optional<int> chosenFelt() const;
  [[nodiscard]] std::optional<int> placeOf(const StiffnessMap& map) const;
  void askMap();
  void followMap();
  void takeMap();
  void dropMap();
  bool mayDropMap(const QString& otherwise, const std::function<void()>& goOn);
  void showMap();
  [[nodiscard]] const SurfaceMap* shownMap() const;
  [[nodiscard]] const StiffnessMap* currentMap() const;
  void showSupports();
  void followSupports();
  void paintByPointer();
  void openSupports();
  [[nodiscard]] const SceneBody& supported() const;
  void checkSurface();
  void makeCheck();
  void closeCheck();
  void lookAtFault();
  void repairSurface();
  // the search for hidden nodules
  void makeTraining();
  void showTraining();
  void startTraining(const TrainingPlan& plan);
  void beginSearch();
  void lockForSearch(bool searches);
  [[nodiscard]] bool isFree();
  void markPlace();
  void finishTraining();
  void takeNodulesOut();
  void askSheet();
  void makePressList();
  void showTicked();
  void pressAgain(int id, const std::function<ForceLaw(const KeptPress&)>& lawOf);
  void fitPressed(int id);
  std::size_t addTake(const ExportFolder& folder);
  void offerPresses();
  void checkSaved();
  bool mayDropPresses();
  void restorePresses();
  void discardPresses();
  void sayListed(const QString& how, std::size_t presses);
  void renamePress(int id, const QString& name);
  void deletePresses(const std::vector<int>& ids);
  void saveAs(int saved);
  [[nodiscard]] SightLine sightLine(double x, double y);
  void aim();
  void followPointer();
  void slide(int right, int up);
  void letGo();
  // what is played: a device's path, or what was recorded
  [[nodiscard]] Pictured recorded(std::size_t ago) const;
  [[nodiscard]] Pictured pictured() const;
  [[nodiscard]] const Sample& sampleToShow();
  void makePlaying();
  void handPlayBar();
  [[nodiscard]] bool isPressing() const;
  void followDevice();
  void play(const PlayOrder& order);
  void addEarlierTakes(QMenu& menu);
  void reviewLatest();
  void review(std::size_t ago);
  void endReview();
  void showPictured();
  void showModel();
  void takeSamples();
  void showInside();
  void clearCharts();
  void refresh();
  void fitView();
  void takeTheme();
  void keepView();
  void setSmooth(bool smooth);
  void smoothen(const Sample& newest);
  void showReadings();
  void refreshPanels();
  void refreshCharts();
  void refreshTiming();
  void showValidity(const Sample& sample);
  void applyTissue();
  bool changeTissue();
  void tellDevices();
  void applyDevice(const QString& name);
  void changeDevice(const std::function<void()>& change);
  bool useFelt(const std::function<Session::Felt()>& work);
  void sayWhatIsKept();
  void sayWhatIsThinned();
  void say(const QString& what);
  void writeCurves(const QString& file, const Plots& plots, std::optional<ImageSize> size);
  void askFigure();
  bool saveInTurn(const std::function<void()>& save);
  bool attempt(const std::function<void()>& work);
  void showProgress(const QString& what, const FollowedWork::Step& step);
  // with a bar to cancel it by; none: it was canceled
  template <typename Made>
  std::optional<Made> inBackground(const QString& what, std::function<Made()> work)
  {
    const auto show = [&](const FollowedWork::Step& step) { showProgress(what, step); };
    const auto end = [&](const MessageBar*) { message_->unfollow(what); };
    const std::unique_ptr<MessageBar, decltype(end)> told(message_, end); // where it fails, too
    return background_.make<Made>(std::move(work), show);
  }
  [[nodiscard]] Exported exported(const Pictured& seen);
  bool exportOne(const QString& to, Exported made, const Timing* timing);
  bool exportMap(const std::filesystem::path& folder, const StiffnessMap& map);
  [[nodiscard]] Pictured filmed();
  bool saveMovie(const QString& file, MovieKind kind);
  bool exportInto(const QString& directory);
  [[nodiscard]] CameraPlace cameraPlace() const;
  void lookFrom(const CameraPlace& place);

  Session& session_;
  vtkNew<vtkGenericOpenGLRenderWindow> renderWindow_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPalpPressStyle> style_;
  PressView view_;
  OtherHand other_;
  Surroundings around_;
  const vtkSmartPointer<vtkRenderPass> fast_;
  Realism realism_;
  vtkSmartPointer<vtkPolyData> coarseTold_; // of the body that is drawn with it
  QAction* realistic_ = nullptr;
  std::optional<bool> hasCard_{}; // whether a graphics card draws; none: not known yet
  Orientation orientation_;
  ScaleBar scaleBar_;
  Balls balls_;
  std::vector<Balls::Ball> marked_; // of a search; none: nodules that are known
  ReachOutline reach_;
  std::unique_ptr<ForceCharts> charts_; // null: the plan names no curves
  QTimer* frames_ = nullptr;            // of the picture
  PointerTool pointer_;
  std::vector<std::shared_ptr<const Surface>> felt_; // by it
  std::uint32_t acting_ = 0; // flags since the panels were last brought up to date
  std::uint32_t acted_ = 0;  // and in the time before
  Validity validity_;        // of the law that the session uses
  Sample shown_;             // in the picture
  bool isStale_ = true;      // the picture, whatever the newest sample is
  int still_ = 0;            // pictures since it last changed
  int timingsLeftOut_ = 0;
  bool chartsAreStale_ = true;
  int panelTurn_ = 0; // 0: of the panels, else of a chart
  std::optional<std::pair<int, int>> fittedTo_ = std::pair(0, 0); // all of the body is seen so
  std::size_t takesKept_;
  WindowMemory memory_;
  bool saidThinned_ = false;
  std::optional<Review> review_; // none: the picture is live
  std::size_t reviewed_ = 0;     // recordings ago
  bool touched_ = false;         // the tool, in the picture before
  QElapsedTimer sincePicture_;
  const ScriptedDevice* scripted_ = nullptr; // that the bar plays
  bool barIsStale_ = false;                  // plays what is no longer there
  PlayOrder order_;                          // that it has
  QVTKOpenGLNativeWidget* canvas_ = nullptr;
  std::vector<ChartPanel*> chartPanels_; // of charts_
  std::vector<ChartPanel*> undrawn_;     // of these, since they were refreshed
  TissuePanel* panel_ = nullptr;
  DevicePanel* devicePanel_ = nullptr;
  ValidityPanel* validityPanel_ = nullptr; // null: the plan rates no sample
  PlotPanel* plots_ = nullptr;             // null: never shown
  OrganList* organs_ = nullptr;            // null: there were no organs so far
  PressBar* pressBar_ = nullptr;
  std::deque<PressPlace> queued_; // to be pressed
  AwaitedPress awaited_;
  QString refusedPlace_;           // why the last press at a place was not made
  PressList* pressList_ = nullptr; // null: no sample is kept
  QUndoStack undo_;
  std::optional<MapWork> mapWork_;   // none: no map is in work
  std::optional<MapWork::Made> map_; // of the body that is open
  bool mapIsStale_ = false;
  QAction* mapColors_ = nullptr;
  std::optional<Search> search_;              // none: nothing is hidden
  TrainingPanel* training_ = nullptr;         // null: never shown
  std::unique_ptr<SupportPainting> painting_; // likewise
  std::unique_ptr<SurfaceCheck> check_;       // likewise
  Autosave* autosave_ = nullptr;              // null: nobody wants it
  std::set<std::filesystem::path> loaded_;    // exports
  PlayBar* playBar_ = nullptr;
  QLabel* forceLabel_ = nullptr;
  MessageBar* message_ = nullptr;
  DiagnosticsPanel* diagnostics_ = nullptr;
  ForceSound sound_;
  Background background_;
  Saves saves_{ *this, background_ };
};

} // namespace palp

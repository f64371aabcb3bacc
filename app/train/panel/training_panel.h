#pragma once

#include "app/input/scene_plan.h"
#include "app/train/score_sheet.h"

#include <QWidget>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace palp
{

/// What a training is, how far it is, and how it went.
class TrainingPanel : public QWidget
{
  Q_OBJECT

public:
  explicit TrainingPanel(const Curriculum& curriculum, QWidget* parent = nullptr);

  /// A search goes on: its level and seed stand in the fields, which cannot be changed.
  void showSearch(const TrainingPlan& plan);

  /// Of the search that goes on.
  /// @param time  since it began [s]
  void showProgress(double time, std::size_t marks);

  /// The search has ended.
  /// @param sheet  null: nothing was touched, so that there is nothing to grade or to save
  void showResult(const ScoreSheet* sheet);

Q_SIGNALS:
  void startAsked(const palp::TrainingPlan& plan);
  void markAsked();
  void finishAsked();
  void saveAsked();
  void refused(const QString& why); ///< what stands in a field

private:
  void start();
  void setSearching(bool searches);

  QComboBox* level_;
  QLineEdit* seed_;
  QPushButton* start_;
  QPushButton* mark_;
  QPushButton* finish_;
  QPushButton* save_;
  QLabel* told_;
};

} // namespace palp

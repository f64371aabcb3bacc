#pragma once

#include "app/sound/force_tone.h"

#include <QIODevice>

#include <atomic>
#include <memory>

class QAudioOutput;

namespace palp
{

/// Plays the tone of a force by the default sound output.
class ForceSound : private QIODevice
{
public:
  ForceSound();
  ~ForceSound() override;
  ForceSound(const ForceSound&) = delete;
  ForceSound& operator=(const ForceSound&) = delete;

  /// @return  false where there is no output that plays
  bool start();
  void stop();

  /// @param force  [N]; 0 is silent
  void setForce(double force) noexcept
  {
    force_ = force;
  }

private:
  qint64 readData(char* data, qint64 most) override;
  qint64 writeData(const char* data, qint64 most) override;
  [[nodiscard]] bool isSequential() const override;

  std::atomic<double> force_{ 0.0 }; // the output may read in a thread of its own
  std::unique_ptr<ForceTone> tone_;
  std::unique_ptr<QAudioOutput> output_;
};

} // namespace palp

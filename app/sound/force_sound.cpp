#include "app/sound/force_sound.h"

#include <QAudioDeviceInfo>
#include <QAudioOutput>

#include <algorithm>
#include <array>
#include <cstring>

namespace palp
{
namespace
{

constexpr int kRate = 44'100;            // [Hz]
constexpr int kAhead = kRate / 25;       // samples of 40 ms, which it is heard late
constexpr qint64 kBytes = sizeof(float); // of a sample

} // namespace

ForceSound::ForceSound() = default;

ForceSound::~ForceSound()
{
  stop();
}

bool ForceSound::start()
{
  QAudioFormat format;
  format.setSampleRate(kRate);
  format.setChannelCount(1);
  format.setSampleSize(8 * static_cast<int>(kBytes));
  format.setSampleType(QAudioFormat::Float);
  format.setCodec("audio/pcm");
  format.setByteOrder(QAudioFormat::LittleEndian);
  const QAudioDeviceInfo device = QAudioDeviceInfo::defaultOutputDevice();
  if (device.isNull() || !device.isFormatSupported(format))
  {
    return false;
  }
  tone_ = std::make_unique<ForceTone>(kRate);
  output_ = std::make_unique<QAudioOutput>(device, format);
  output_->setBufferSize(kAhead * static_cast<int>(kBytes));
  open(QIODevice::ReadOnly);
  output_->start(this);
  const bool plays = output_->error() == QAudio::NoError;
  plays ? void() : stop();
  return plays;
}

void ForceSound::stop()
{
  output_ = nullptr;
  close();
}

qint64 ForceSound::readData(char* data, qint64 most)
{
  std::array<float, kAhead> samples;
  const auto count = static_cast<std::size_t>(std::clamp<qint64>(most / kBytes, 0, kAhead));
  tone_->fill(force_, { samples.data(), count });
  std::memcpy(data, samples.data(), count * sizeof(float));
  return static_cast<qint64>(count) * kBytes;
}

qint64 ForceSound::writeData(const char* /*data*/, qint64 /*most*/)
{
  return -1;
}

bool ForceSound::isSequential() const
{
  return true;
}

} // namespace palp

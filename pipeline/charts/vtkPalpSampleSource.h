/**
 * @class   vtkPalpSampleSource
 * @brief   the samples of the servo loop as tables for charts
 *
 * Output 0, force against time: float columns "time [s]" and "force [N]", two rows for each
 * interval, the least and the largest force in it, in the order in which they came. About Columns
 * intervals fill the part of the last seconds, Span of them, that is looked at; they are no shorter
 * than a Finest of the span.
 * Output 1, force against depth: float columns "depth [mm]" and "force [N]", the last Points
 * samples of the same seconds that differ from the one before by something that can be seen.
 *
 * Adding a sample costs the same however many there were, and so does an update.
 */

#pragma once

#include "haptics/servo/sample.h"
#include "pipeline/model/sample_columns.h"

#include <vector>
#include <vtkTableAlgorithm.h>

class vtkPalpSampleSource : public vtkTableAlgorithm
{
public:
  vtkTypeMacro(vtkPalpSampleSource, vtkTableAlgorithm);
  static vtkPalpSampleSource* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  static constexpr double Minute = 60.0;       ///< [s]
  static constexpr std::size_t Columns = 800;  ///< of output 0
  static constexpr std::size_t Finest = 12000; ///< of the span: 5 ms of a minute
  static constexpr std::size_t Points = 2000;  ///< of output 1

  ///@{
  /**
   * Seconds of output 0; to be set before the first sample. Default: Minute.
   */
  void SetSpan(double seconds);
  vtkGetMacro(Span, double);
  ///@}

  /**
   * The part of the span that output 0 is of [s]. Default: all of it.
   */
  void LookAt(double from, double to);

  /**
   * Appends one sample; its time must not be less than that of the one before.
   */
  void AddSample(const palp::Sample& sample);

  /**
   * Forgets all samples.
   */
  void Clear();

  ///@{
  /**
   * Time of the first and of the last sample since Clear [s]; 0 without one.
   */
  vtkGetMacro(FirstTime, double);
  vtkGetMacro(LastTime, double);
  ///@}

protected:
  vtkPalpSampleSource();
  ~vtkPalpSampleSource() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPalpSampleSource(const vtkPalpSampleSource&) = delete;
  void operator=(const vtkPalpSampleSource&) = delete;

  struct Point
  {
    double Depth; // [m]
    double Force; // [N]
    double Time;  // [s]
  };

  double Span = Minute;
  palp::SampleColumns Time{ Minute, Finest };
  double From = 0.0;
  double To = Minute;
  std::vector<Point> Depths; // ring of Points
  std::size_t NextDepth = 0;
  bool Empty = true;
  double FirstTime = 0.0;
  double LastTime = 0.0;
};

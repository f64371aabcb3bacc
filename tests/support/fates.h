#pragma once

#include "tests/support/damage.h"
#include "tests/support/sampled.h"

#include <string>
#include <vector>

namespace palp::test
{

/// How far a file came.
enum class Stage : int
{
  Reading,
  Taking,
  Done,
};

/// What became of one damaged file.
struct Result
{
  const Fault* fault = nullptr; ///< see Damaged
  Stage reached = Stage::Reading;
  bool refused = false;
  double time = 0.0; ///< [s] of processor time
  double peak = 0.0; ///< [GB]
  char message[1000] = {};
};

/// What became of the damaged files of a kind.
struct Fates
{
  int count = 0;
  int read = 0;
  int refused = 0;
  int crashed = 0;                  ///< the reader; told as a refusal
  int known = 0;                    ///< refused files whose one fault is known
  int named = 0;                    ///< of these, those whose sentence names it
  double longest = 0.0;             ///< [s] of processor time
  double peak = 0.0;                ///< [GB] of memory
  std::vector<std::string> wrong;   ///< what must not be, a line each
  std::vector<std::string> unnamed; ///< known faults with another sentence, some of them
};

/// Adds one to the fates.
/// @param number  of the file
void judge(const Fuzzed& kind, int number, const Result& result, Fates& fates);

/// Prints a line of figures, and fails where 5 s, 1 GB, or 95 % of named causes are missed.
void expectGoodFates(const Fuzzed& kind, const Fates& fates);

} // namespace palp::test

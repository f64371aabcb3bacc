#pragma once

/// What the made-up arm does and was told.
struct DrdArm
{
  bool there = true;
  bool open = false;
  bool initialized = false; ///< its pole was put into its pit
  bool enables = true;      ///< its motors, when asked to
  bool forceOn = false;
  const char* name = "omega.7";
  bool hasWrist = true;
  bool hasActiveWrist = false;
  int watchdog = 0;
  double place[3] = { 0, 0, 0 };
  double frame[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  double force[3] = { 0, 0, 0 };
  double torque[3] = { 0, 0, 0 };
};

extern "C" DrdArm* drdArm();

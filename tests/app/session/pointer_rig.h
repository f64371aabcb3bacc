#pragma once

#include "tests/app/session/pointer_bench.h"
#include "tests/app/session/pressed_bodies.h"

#include <gtest/gtest.h>

namespace palp::test
{

/// A pointer over a block, with a sphere for a tool.
class PointerRig : public ::testing::Test
{
protected:
  [[nodiscard]] double asked() const
  {
    return bench.pointer.target() ? bench.pointer.target()->depth : -1.0;
  }

  PointerBench bench{ block(), SphereTip{ 10.0_mm }, kAbove };
  PointerTool& pointer = bench.pointer;
};

} // namespace palp::test

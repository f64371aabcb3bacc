#pragma once

#include "app/pictures.h"

namespace palp
{

/// Draws off screen, without any display server.
class DrawPictures final : public Pictures
{
public:
  void drawPress(const Body& body, const Recording& recording, const ExtentTable& extents,
    const std::filesystem::path& directory, ImageSize size) const override;
};

} // namespace palp

#pragma once

#include "haptics/contact/contact.h"
#include "haptics/pose.h"
#include "haptics/surface/surface.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// How the depth is measured.
enum class ContactRule
{
  Exact, ///< to the triangles: contact starts at depth > 0 whatever the mesh
  Paper, ///< Sec. 4.1: mesh points inside the tool, depth from their center
};

/// The ball outside of which a tool touches no closed body, and meets no sheet from its front.
struct Reach
{
  Eigen::Vector3d center; ///< [m]
  double radius;          ///< [m]
};

/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Reach reachOf(const Tip& tip, const ToolPose& pose, ContactRule rule) noexcept;

/// Where and how deep the tool is in the undeformed surface.
///
/// depth is how far the tool's deepest point along the contact normal lies below the surface
/// (sphere: R minus the distance from its center to the surface; cone: its apex). Exact: below a
/// smooth body that has as much in common with a ball about the center as the mesh has; that ball
/// smooths the facets out over 0.6 of the contact's radius, at least 1.8 and at most 6.5 edge
/// lengths, but never beyond the contact. So it is a smooth function of the pose, starts where the
/// tool touches a triangle, and is that of the true plane or sphere under a mesh of one.
///
/// A tool without a round nose is as deep as it would be in a smooth body from which its circles of
/// contact cut as much, by volume, or by lift where it has a flat: half over an edge a cone is 0.79
/// times as deep, a punch 0.71, which pushes half as much. It is met where the circle of contact
/// is, not where its flank first touches the edge beside.
///
/// The contact carries the slopes of what a law asks for, so that the force is the gradient of one
/// energy: a tool that is pressed in, dragged along and lifted gains no work.
///
/// Two lobes at once share the normal and, where they press against a round nose, fade the depth.
/// A nose whose center is inside a body is pushed out the nearest way; where a triangle is
/// turned over, those about it say what is inside. An open sheet is pressed from its front only, by
/// tools whose axis points against its normal; past its edge, contact fades out, and pushes away.
///
/// @param surface  undeformed
/// @param tip      checked
/// @param pose     axis of unit length; a value that is not finite gives no contact
/// @param of       what counts as the curvature that a law is told
/// @source         Sec. 4.1
/// @realtime       pure; no allocation, no lock, no exception
[[nodiscard]] Contact findContact(const Surface& surface, const Tip& tip, const ToolPose& pose,
  ContactRule rule, CurvatureOf of = CurvatureOf::All) noexcept;

} // namespace palp

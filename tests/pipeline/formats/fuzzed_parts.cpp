#include "tests/pipeline/formats/fuzzed_parts.h"

#include "haptics/contact/find_contact.h"
#include "haptics/units.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vtkPolyData.h>

namespace palp::test
{
namespace
{

using namespace units::literals;

std::string readSurfaceBytes(const std::filesystem::path& file)
{
  return pack(readFile(file));
}

void press(const std::string& bytes, const std::string& name)
{
  const auto read = unpack(bytes);
  if (!read)
  {
    throw std::runtime_error("the answer of the reader is damaged");
  }
  const LoadedSurface loaded = madeReady(*read, name, LengthUnit::Millimeter);
  const Surface surface(pointsOf(*loaded.mesh), trianglesOf(*loaded.mesh));
  for (std::size_t i = 0; i < surface.points().size(); i += 1 + surface.points().size() / 20)
  {
    const Eigen::Vector3d normal = surface.normals()[i];
    const Contact contact = findContact(surface, SphereTip{ 5.0_mm },
      { .apex = surface.points()[i] - 1.0_mm * normal, .axis = -normal }, ContactRule::Exact);
    if (!std::isfinite(contact.depth) || !contact.normal.allFinite() || !contact.center.allFinite())
    {
      throw std::runtime_error("a contact that is not finite");
    }
  }
}

} // namespace

Mesh ball()
{
  return makeSphere(50.0, 1);
}

vtkSmartPointer<vtkPolyData> ballData()
{
  return makePolyData(ball().points, ball().triangles);
}

std::string ballText(
  const std::string& head, const std::string& point, const std::string& corner, int first)
{
  std::ostringstream text;
  text << head;
  for (const Eigen::Vector3d& p : ball().points)
  {
    text << point << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const Triangle& t : ball().triangles)
  {
    text << corner << t[0] + first << ' ' << t[1] + first << ' ' << t[2] + first << '\n';
  }
  return text.str();
}

std::string offText()
{
  const Mesh mesh = ball();
  return ballText("OFF\n" + std::to_string(mesh.points.size()) + ' ' +
      std::to_string(mesh.triangles.size()) + " 0\n",
    "", "3 ", 0);
}

std::string readImageBytes(const std::filesystem::path& file)
{
  return pack(readFile(file, { .level = 0.0, .labels = {} }));
}

Fuzzed surface(const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults)
{
  return { .file = file,
    .whole = std::move(whole),
    .faults = std::move(faults),
    .read = readSurfaceBytes,
    .take = [file](const std::string& bytes) { press(bytes, file); } };
}

Fuzzed image(const std::string& file, std::vector<std::string> whole, std::vector<Fault> faults)
{
  Fuzzed kind = surface(file, std::move(whole), std::move(faults));
  kind.read = readImageBytes;
  return kind;
}

} // namespace palp::test

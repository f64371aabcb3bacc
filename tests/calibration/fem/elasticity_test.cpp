#include "calibration/baselines/corotational.h"
#include "calibration/baselines/mass_spring.h"
#include "calibration/fem/constitutive.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <random>

namespace palp::fem
{
namespace
{

using namespace units::literals;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kSize = 20.0_mm;

Matrix3Xd shaken(const Matrix3Xd& positions, double by, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-by, by);
  Matrix3Xd result = positions;
  for (double& x : result.reshaped())
  {
    x += shift(random);
  }
  return result;
}

// irregular elements
TetMesh someMesh()
{
  TetMesh mesh = blockTets(kSize, kSize, 4, 4);
  mesh.positions = shaken(mesh.positions, 0.08 * kSize / 3.0, 7);
  return mesh;
}

double wholeVolume(const TetMesh& mesh)
{
  double sum = 0.0;
  for (const auto& tet : mesh.tets)
  {
    sum += volume(mesh.positions, tet);
  }
  return sum;
}

struct Answer
{
  double energy;
  Matrix3Xd forces;
};

struct Model
{
  explicit Model(const std::string& kind, const Material& material = { 50.0_kPa, 0.33 })
    : mesh(someMesh())
    , matrix(static_cast<int>(mesh.positions.cols()), mesh.tets)
  {
    if (kind == "tetrahedra")
    {
      elasticity = std::make_unique<CorotationalTets>(mesh, matrix, material);
    }
    else
    {
      elasticity = std::make_unique<MassSprings>(mesh, matrix, material, kind == "volumes");
    }
  }

  Answer operator()(const Matrix3Xd& x)
  {
    Matrix3Xd forces(3, x.cols());
    const double energy = elasticity->evaluate(x, forces, matrix);
    return { energy, forces };
  }

  Matrix3Xd stiffnessTimes(const Matrix3Xd& u)
  {
    Matrix3Xd product(3, u.cols());
    matrix.multiply(u, product);
    return product;
  }

  TetMesh mesh;
  BlockMatrix matrix;
  std::unique_ptr<Elasticity> elasticity;
};

constexpr double kForce = 50.0_kPa * kSize * kSize; // by which forces are called small [N]

Matrix3Xd moved(const Matrix3Xd& x)
{
  const Matrix3d turn = Eigen::AngleAxisd(2.5, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return (turn * x).colwise() + Vector3d(0.3, -0.1, 0.2);
}

class AnyElasticity : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(
  Elasticity, AnyElasticity, testing::Values("springs", "volumes", "tetrahedra"));

TEST_P(AnyElasticity, RigidMotionTakesNoForce)
{
  Model model(GetParam());
  const Answer answer = model(moved(model.mesh.positions));
  EXPECT_LT(answer.forces.lpNorm<Eigen::Infinity>(), 1e-10 * kForce);
  EXPECT_LT(answer.energy, 1e-16 * kForce * kSize);
}

TEST_P(AnyElasticity, ForcesAreMinusTheGradientOfTheEnergy)
{
  Model model(GetParam());
  const Matrix3Xd at = shaken(moved(model.mesh.positions), 0.1 * kSize / 3.0, 1);
  const Matrix3Xd forces = model(at).forces;
  const double h = 1e-3 * kSize;
  for (Eigen::Index i = 0; i < at.size(); i += 5)
  {
    const auto energy = [&](double by)
    {
      Matrix3Xd x = at;
      x.reshaped()[i] += by;
      return model(x).energy;
    };
    const double slope =
      (8.0 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12.0 * h);
    EXPECT_NEAR(forces.reshaped()[i], -slope, 1e-7 * kForce) << i;
  }
}

TEST_P(AnyElasticity, StiffnessIsTheDerivativeOfTheForcesWhereUndeformed)
{
  Model model(GetParam());
  const Matrix3Xd at = moved(model.mesh.positions);
  (void)model(at);
  const Matrix3Xd change = shaken(Matrix3Xd::Zero(3, at.cols()), 1.0, 2);
  const Matrix3Xd expected = model.stiffnessTimes(change);
  const double h = 1e-5 * kSize;
  const Matrix3Xd slope =
    (model(at - h * change).forces - model(at + h * change).forces) / (2.0 * h);
  EXPECT_LT((slope - expected).norm(), 1e-6 * expected.norm());
}

TEST_P(AnyElasticity, StiffnessIsSymmetricAndNeverNegative)
{
  Model model(GetParam());
  (void)model(shaken(model.mesh.positions, 0.8 * kSize / 3.0, 3)); // some elements inside out
  const auto size = model.mesh.positions.size();
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const Matrix3Xd zero = Matrix3Xd::Zero(3, size / 3);
    const Matrix3Xd u = shaken(zero, 1.0, seed);
    const Matrix3Xd v = shaken(zero, 1.0, 100 + seed);
    const double scale = u.norm() * model.stiffnessTimes(u).norm();
    EXPECT_NEAR(u.cwiseProduct(model.stiffnessTimes(v)).sum(),
      v.cwiseProduct(model.stiffnessTimes(u)).sum(), 1e-12 * scale);
    EXPECT_GE(u.cwiseProduct(model.stiffnessTimes(u)).sum(), 0.0);
  }
}

// inner forces neither push nor turn the whole body
TEST_P(AnyElasticity, ForcesAndTheirMomentsAddUpToNothing)
{
  Model model(GetParam());
  const Matrix3Xd at = shaken(model.mesh.positions, 0.3 * kSize / 3.0, 4);
  const Matrix3Xd forces = model(at).forces;
  Vector3d moment = Vector3d::Zero();
  for (Eigen::Index i = 0; i < at.cols(); ++i)
  {
    moment += at.col(i).cross(forces.col(i));
  }
  EXPECT_LT(forces.rowwise().sum().norm(), 1e-12 * kForce);
  EXPECT_LT(moment.norm(), 1e-10 * kForce * kSize); // as exact as the rotations are
}

TEST_P(AnyElasticity, ForcesScaleWithYoungsModulus)
{
  Model soft(GetParam(), { 1.0_kPa, 0.49 });
  Model hard(GetParam(), { 1.5_MPa, 0.49 });
  const Matrix3Xd at = shaken(soft.mesh.positions, 0.2 * kSize / 3.0, 5);
  const Matrix3Xd a = soft(at).forces;
  const Matrix3Xd b = hard(at).forces;
  EXPECT_LT((1500.0 * a - b).norm(), 1e-10 * b.norm());
}

// patch test against the energy density of the static elements, which finds R by singular values
TEST(CorotationalTets, LinearFieldsGiveTheEnergyOfTheMaterialAndBalance)
{
  const Material tissue{ 50.0_kPa, 0.49 };
  const Matrix3d turn = Eigen::AngleAxisd(1.9, Vector3d(2, -1, 1).normalized()).toRotationMatrix();
  Matrix3d shear = Matrix3d::Identity();
  shear(0, 1) = 0.7;
  const Matrix3d squeezed = Vector3d(1.2, 1.1, 0.4).asDiagonal();
  const Matrix3d through = Vector3d(1.2, 1.1, -0.4).asDiagonal();
  for (const Matrix3d& f :
    { shear, squeezed, through, Matrix3d(turn * shear), Matrix3d(turn * through) })
  {
    Model model("tetrahedra", tissue);
    const Answer answer = model(f * model.mesh.positions);
    const double exact =
      evaluate(StrainEnergy::Corotated, tissue, f).energy * wholeVolume(model.mesh);
    EXPECT_NEAR(answer.energy, exact, 1e-9 * exact);
    const int inner = (1 * 4 + 1) * 4 + 1;
    EXPECT_LT(answer.forces.col(inner).norm(), 1e-9 * answer.forces.norm());
  }
}

// springs have nu = 1/4, with volumes held it is the given one; both in the mean over directions
Material solidOf(const std::string& kind, const Material& tissue)
{
  return { tissue.youngModulus, kind == "springs" ? 0.25 : tissue.poissonRatio };
}

double smallStrainEnergy(Model& model, const Matrix3d& strain)
{
  (void)model(model.mesh.positions);
  const Matrix3Xd u = strain * model.mesh.positions;
  return 0.5 * u.cwiseProduct(model.stiffnessTimes(u)).sum() / wholeVolume(model.mesh);
}

class AnySprings : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(MassSprings, AnySprings, testing::Values("springs", "volumes"));

TEST_P(AnySprings, SwellingTakesTheEnergyOfTheSolid)
{
  const Material tissue{ 50.0_kPa, 0.4 };
  Model model(GetParam(), tissue);
  const Material solid = solidOf(GetParam(), tissue);
  const double bulk = solid.youngModulus / (3.0 * (1.0 - 2.0 * solid.poissonRatio));
  EXPECT_NEAR(smallStrainEnergy(model, Matrix3d::Identity()), 4.5 * bulk, 1e-10 * bulk);
}

// averaged over the six axes of an icosahedron, which is exact for fourth powers
TEST_P(AnySprings, StretchingTakesTheEnergyOfTheSolidInTheMeanOverDirections)
{
  const Material tissue{ 50.0_kPa, 0.4 };
  Model model(GetParam(), tissue);
  const double g = std::numbers::phi;
  double mean = 0.0;
  for (const Vector3d& axis : { Vector3d(0, 1, g), Vector3d(0, -1, g), Vector3d(1, g, 0),
         Vector3d(-1, g, 0), Vector3d(g, 0, 1), Vector3d(g, 0, -1) })
  {
    const Vector3d a = axis.normalized();
    mean += smallStrainEnergy(model, a * a.transpose()) / 6.0;
  }
  const Material solid = solidOf(GetParam(), tissue);
  const double nu = solid.poissonRatio;
  const double uniaxial = solid.youngModulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  EXPECT_NEAR(mean, 0.5 * uniaxial, 1e-10 * uniaxial);
}

TEST(NearestRotation, IsThatOfThePolarDecompositionFromAnywhere)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    const Vector3d axis(any(random), any(random), any(random));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(3.0 * any(random), axis.normalized()));
    Matrix3d stretch = Matrix3d::Identity();
    for (int i = 0; i < 3; ++i)
    {
      const Vector3d along = Vector3d(any(random), any(random), any(random)).normalized();
      stretch += (any(random) > 0.0 ? 2.0 : -0.3) * along * along.transpose();
    }
    const Eigen::Quaterniond found =
      nearestRotation(turn * stretch, Eigen::Quaterniond::Identity());
    EXPECT_LT(found.angularDistance(turn), 1e-7) << k;
  }
}

} // namespace
} // namespace palp::fem

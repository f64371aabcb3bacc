#include "haptics/force/nodules/layer_image.h"

#include "haptics/numerics/quadrature.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr int kWavenumbers = 200;
constexpr double kLargest = 45.0; // times the thickness; what is left out is below 1e-16
constexpr SplineAxis kAcross{ 0.0, LayerImage::kReach, 90 };
constexpr SplineAxis kDown{ 0.0, 1.0, 60 };

// The four solutions of a wavenumber k at the depth t = k z: e^-t, t e^-t, and with e^(t-k) both.
struct Modes
{
  Eigen::RowVector4d down;      // displacement along z
  Eigen::RowVector4d across;    // along r
  Eigen::RowVector4d downSlope; // d/dz
  Eigen::RowVector4d dilation;  // trace of the strain
  Eigen::RowVector4d shear;     // d across / dz - k down
};

Modes modesAt(double k, double t, double nu)
{
  const double fall = std::exp(-t);
  const double rise = std::exp(t - k);
  const double kappa = 3.0 - 4.0 * nu;
  const double m = 2.0 * (1.0 - 2.0 * nu);
  Modes modes;
  modes.down << fall, t * fall, rise, t * rise;
  modes.across << fall, (t - kappa) * fall, -rise, -(kappa + t) * rise;
  modes.downSlope << -k * fall, k * (1.0 - t) * fall, k * rise, k * (1.0 + t) * rise;
  modes.dilation << 0.0, -m * k * fall, 0.0, -m * k * rise;
  Eigen::RowVector4d acrossSlope;
  acrossSlope << -k * fall, k * (1.0 - t + kappa) * fall, -k * rise, -k * (1.0 + kappa + t) * rise;
  modes.shear = acrossSlope - k * modes.down;
  return modes;
}

// how much of each mode the base adds under a unit pressure
Eigen::Vector4d amplitudes(double k, double nu, Base base)
{
  const double shear = 0.5 / (1.0 + nu); // E = 1
  const double lambda = 2.0 * shear * nu / (1.0 - 2.0 * nu);
  const Modes top = modesAt(k, 0.0, nu);
  const Modes bottom = modesAt(k, k, nu);
  Eigen::Matrix4d equations;
  equations.row(0) = lambda * top.dilation + 2.0 * shear * top.downSlope;
  equations.row(1) = shear * top.shear;
  equations.row(2) = bottom.down;
  equations.row(3) = base == Base::Slip ? bottom.shear : bottom.across;
  Eigen::Vector4d layer = equations.partialPivLu().solve(Eigen::Vector4d(-1.0, 0.0, 0.0, 0.0));
  layer.head<2>() -=
    equations.topLeftCorner<2, 2>().partialPivLu().solve(Eigen::Vector2d(-1.0, 0.0));
  return layer;
}

// amplitudes of the strains at one depth, by wavenumber
struct Spectrum
{
  std::vector<double> zz, radial, shear;
};

Spectrum spectrumAt(
  double z, const Quadrature& waves, const std::vector<Eigen::Vector4d>& modes, double nu)
{
  Spectrum spectrum;
  for (std::size_t i = 0; i < modes.size(); ++i)
  {
    const double k = waves.nodes[i];
    const double weight = waves.weights[i] * k / (2.0 * std::numbers::pi);
    const Modes at = modesAt(k, k * z, nu);
    spectrum.zz.push_back(weight * at.downSlope.dot(modes[i]));
    spectrum.radial.push_back(weight * k * at.across.dot(modes[i]));
    spectrum.shear.push_back(weight * 0.5 * at.shear.dot(modes[i]));
  }
  return spectrum;
}

} // namespace

LayerImage::LayerImage(double poissonRatio, Base base)
{
  const Quadrature waves = gaussLegendre(kWavenumbers, 0.0, kLargest);
  std::vector<Eigen::Vector4d> modes;
  for (const double k : waves.nodes)
  {
    modes.push_back(amplitudes(k, poissonRatio, base));
  }
  std::vector<Spectrum> depths;
  for (int i = 0; i <= kDown.intervals; ++i)
  {
    depths.push_back(spectrumAt(i * kDown.step(), waves, modes, poissonRatio));
  }

  std::array<std::vector<double>, 4> tables;
  std::vector<double> j0(modes.size());
  std::vector<double> j1(modes.size());
  for (int i = 0; i <= kAcross.intervals; ++i)
  {
    const double r = i * kAcross.step();
    for (std::size_t w = 0; w < modes.size(); ++w)
    {
      j0[w] = ::j0(waves.nodes[w] * r);
      j1[w] = ::j1(waves.nodes[w] * r);
    }
    for (const Spectrum& at : depths)
    {
      Strain sum;
      for (std::size_t w = 0; w < modes.size(); ++w)
      {
        const double around = i > 0 ? j1[w] / (waves.nodes[w] * r) : 0.5;
        sum = sum +
          Strain{ at.radial[w] * (j0[w] - around), at.radial[w] * around, at.zz[w] * j0[w],
            at.shear[w] * j1[w] };
      }
      tables[0].push_back(sum.rr);
      tables[1].push_back(sum.tt);
      tables[2].push_back(sum.zz);
      tables[3].push_back(sum.rz);
    }
  }
  for (const std::vector<double>& table : tables)
  {
    parts_.emplace_back(kAcross, kDown, table);
  }
}

Strain LayerImage::operator()(double r, double z) const noexcept
{
  return { parts_[0](r, z).value, parts_[1](r, z).value, parts_[2](r, z).value,
    parts_[3](r, z).value };
}

} // namespace palp

#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/table.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>

namespace dalembert::bench {

namespace {

void write(const DiagramsOptions& options, const std::string& name, const Table& table) {
  const std::string path = options.directory + '/' + name;
  std::ofstream file(path);
  table.write_csv(file);
  if (!file.flush()) throw Error(path + " could not be written");
  std::cout << path << ": " << table.rows.size() << " rows\n";
}

EquilibriumOptions<3> about_z(double rate) { return {.turning = {.rate = {0.0, 0.0, rate}}}; }

/// The angle from the vertical of `bob`, whose handle each build leaves, on all branches.
template <class Build>
Table branches(const Build& build, const Particle<3>& bob, double from, double to) {
  Table table{.columns = {"branch", "rate", "angle_deg", "softest"}, .rows = {}};
  const auto diagram = follow_branches<3>(build, {.from = from, .to = to});
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    const auto row = [&](const auto& point) {
      const Vec<3> r = point.state.sample().position(bob);
      const double angle = std::atan2(r.x(), -r.z()) * 180.0 / std::numbers::pi;
      table.rows.push_back({std::to_string(b), scientific(point.parameter, 8), scientific(angle, 8),
                            scientific(point.softest)});
    };
    if (diagram.branches[b].origin != no_bifurcation) row(diagram.bifurcations[diagram.branches[b].origin]);
    for (const auto& point : diagram.branches[b].points) row(point);
  }
  return table;
}

double growth(double amplitude, double x) {
  auto pivot = models::DrivenPivot::vertical(amplitude);
  pivot.gravity = x * pivot.frequency * pivot.frequency;
  pivot.angle = std::numbers::pi;
  return floquet(pivot.scene().scene, 2.0 * std::numbers::pi / pivot.frequency).growth();
}

constexpr double widest = 0.6, highest = 0.12;  // of the chart

Table chart(int points) {
  Table table{.columns = {"amplitude", "gravity", "growth"}, .rows = {}};
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const double A = widest * (i + 0.5) / points, x = highest * (k + 0.5) / points;
      table.rows.push_back({scientific(A), scientific(x), scientific(growth(A, x), 8)});
    }
  }
  return table;
}

/// The lowest eigenvalue of Mathieu's equation y'' + (a - 2 q cos 2t) y = 0 among its Fourier series: a_0(q)
/// of the even ones of period pi, b_1(q) of the odd ones of period 2 pi (Abramowitz, Stegun, 20.2).
double mathieu(double q, bool even) {
  constexpr int terms = 20;
  Eigen::VectorXd diagonal(terms), beside = Eigen::VectorXd::Constant(terms - 1, q);
  for (int k = 0; k < terms; ++k) diagonal[k] = std::pow(even ? 2 * k : 2 * k + 1, 2);
  if (even) {
    beside[0] *= std::numbers::sqrt2;
  } else {
    diagonal[0] -= q;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

/// Upright on a pivot that goes A cos(omega t) down: a = -4 g/(l omega^2), |q| = 2 A/l.
Table boundary() {
  Table table{.columns = {"side", "amplitude", "gravity"}, .rows = {}};
  constexpr int points = 300;
  for (const bool even : {true, false}) {
    for (int i = 0; i <= points; ++i) {
      const double A = widest * i / points, x = -mathieu(2.0 * A, even) / 4.0;
      if (x >= 0.0 && x <= highest)
        table.rows.push_back({even ? "lower" : "upper", scientific(A, 8), scientific(x, 8)});
    }
  }
  return table;
}

}  // namespace

void diagrams(const DiagramsOptions& options) {
  Particle<3> bob;
  const auto hoop = [&bob](double spin) {
    auto built = models::HoopAboutDiameter{.spin = spin, .angle = 0.0}.scene();
    bob = built.bead;
    return Posed<3>{std::move(built.scene), about_z(spin)};
  };
  write(options, "hoop.csv", branches(hoop, bob, 1.0, 8.0));
  const auto governor = [&bob](double spin) {
    auto built = models::Governor{.spin = spin, .angle = 0.0}.scene();
    bob = built.parts.masses[0];
    return Posed<3>{std::move(built.scene), about_z(spin)};
  };
  write(options, "governor.csv", branches(governor, bob, 2.0, 14.0));
  write(options, "kapitza.csv", chart(options.points));
  write(options, "kapitza-boundary.csv", boundary());
}

}  // namespace dalembert::bench

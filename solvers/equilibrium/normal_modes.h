#pragma once

#include <dalembert/solvers/equilibrium/equilibrium.h>

#include <complex>
#include <string>
#include <vector>

namespace dalembert {

/// Whether a slightly disturbed scene stays near its equilibrium; free motions apart.
enum class Stability {
  stable,    ///< every mode decays, or vibrates with positive energy to which no force adds
  unstable,  ///< some mode grows
  undecided  ///< the linear terms do not decide
};
/// As it appears in reports.
[[nodiscard]] const char* name(Stability stability);

/// A solution of the equations of small motions, u = shape exp(eigenvalue t), as flat numbers.
struct Mode {
  std::complex<double> eigenvalue;          ///< [1 / time]; of a conjugate pair the one with Im > 0
  std::vector<std::complex<double>> shape;  ///< one number per coordinate, the largest is 1
  bool free = false;    ///< eigenvalue 0, and all of a finite motion along the shape is in balance
  bool decays = false;  ///< surely: the real part is negative by more than it is known to
};

struct Modes {
  std::vector<Mode> modes;  ///< those of eigenvalue 0 first, the others by increasing modulus
  Stability stability = Stability::undecided;
  std::string reason;  ///< of `stability`, in a sentence
};

struct ModesOptions {
  /// How many modes are wanted, those of least |eigenvalue|; 0: all, for up to 600 coordinates.
  std::size_t lowest = 0;
};

namespace detail {
/// Whether two scenes have their points in common, as far as both have any: copies of one.
[[nodiscard]] bool same_elements(const Layout& a, const Layout& b);
}  // namespace detail

/// For a System and what `find_equilibrium` gave, out of which `normal_modes` makes NormalModes.
/// About a steady motion `motion` stands for the turning.
[[nodiscard]] Modes find_modes(const System& system, const Record& found, const UniformRotation<3>& turning,
                               const ModesOptions& options, const UniformMotion* motion = nullptr);

/// The small motions about an equilibrium, read by handle. Functions of a mode k throw InvalidArgument if
/// there is none.
template <int D>
class NormalModes {
 public:
  /// `note` is added to what `describe` says.
  NormalModes(std::shared_ptr<const Layout> layout, Modes modes, std::string note = {})
      : layout_(std::move(layout)), modes_(std::move(modes)), note_(std::move(note)) {}
  NormalModes(const NormalModes&) = default;             ///< also of one that is moved
  NormalModes& operator=(const NormalModes&) = default;  ///< likewise

  /// Of modes.
  [[nodiscard]] std::size_t size() const { return modes_.modes.size(); }
  /// [1 / time]; of a conjugate pair the one with Im > 0.
  [[nodiscard]] std::complex<double> eigenvalue(std::size_t k) const { return mode(k).eigenvalue; }
  [[nodiscard]] double frequency(std::size_t k) const { return mode(k).eigenvalue.imag(); }  ///< [rad/time]
  [[nodiscard]] double damping(std::size_t k) const { return -mode(k).eigenvalue.real(); }   ///< [1/time]
  /// Whether the scene moves freely along this mode: there are equilibria all along it.
  [[nodiscard]] bool is_free(std::size_t k) const { return mode(k).free; }

  /// The motion of a particle or a point of a body in a mode, in the rotating frame, is the real part of
  /// shape exp(eigenvalue t). The largest number of a mode's shape is 1; a driven point, whose path nothing
  /// disturbs, has 0.
  template <Point P>
  [[nodiscard]] VecOf<std::complex<double>, P::dimension> shape(std::size_t k, const P& point) const {
    const std::vector<std::complex<double>>& all = mode(k).shape;
    if constexpr (P::driven) return VecOf<std::complex<double>, P::dimension>::Zero();
    std::vector<double> re, im;
    for (const auto& one : all) {
      re.push_back(one.real());
      im.push_back(one.imag());
    }
    const auto read = [&](const std::vector<double>& part) {
      FlatSample flat;
      flat.v = flat.q = part;
      const Sample<D> sample(*layout_, flat);
      if constexpr (P::dimension == D) {
        return sample.velocity(point);
      } else {
        return Vec<1>(sample.angular_velocity(point));
      }
    };
    const auto real = read(re), imaginary = read(im);
    VecOf<std::complex<double>, P::dimension> shape;
    for (int k = 0; k < P::dimension; ++k) shape[k] = {real[k], imaginary[k]};
    return shape;
  }

  /// The verdict.
  [[nodiscard]] Stability stability() const { return modes_.stability; }
  /// The verdict with its reason, and the free motions with the bodies, particles and rotors that move most
  /// in them; and what the equilibrium leaves out.
  [[nodiscard]] std::string describe() const;

 private:
  [[nodiscard]] const Mode& mode(std::size_t k) const;

  std::shared_ptr<const Layout> layout_;
  Modes modes_;
  std::string note_;
};

extern template class NormalModes<2>;
extern template class NormalModes<3>;

/// Frequencies, damping and shapes of the small motions u of a scene about its equilibrium, on the tangent
/// space of the constraints and in the frame that rotates with it:
///
///   M u'' + (2 M A + D) u' + (H + D A + M A^2) u = W^T y,      W u = 0   (nonholonomic: of u', see below)
///   (1)
///
/// with H = -(F + W^T lambda)_q, which contains the curvature of the constraints -sum lambda g_qq, D = -F_v,
/// and A the rotation, v = A (q - p). A compliant constraint is the spring that it is; a nonholonomic one
/// gives psi_v (u' + A u) + psi_q u = 0. Linear terms do not tell what a mode of eigenvalue 0 is: moved along
/// it by a finite distance and brought into balance again the scene shows whether it moves there freely.
///
/// Verdict: unstable if an eigenvalue has a positive real part; stable if all but those of free motions
/// decay, or vibrate with an energy u'.M u'/2 + u.(H + M A^2).u/2 > 0, which is then a Lyapunov function;
/// otherwise undecided: an eigenvalue 0 that is no free motion (a bifurcation), or a vibration of negative
/// energy that is stabilised by gyroscopic forces only. About a steady motion an energy > 0 in any frame in
/// which the state rests will do: of a top that sleeps, in one that turns about its axis. So will a mirror
/// that, with time reversed, leaves it as it is, where it has but one vibration: a disk that rolls above its
/// critical spin stays near its path up to where that lies ("How it works" has the proof).
///
/// About a steady motion it is stable also where all decays but as many motions as symmetries of the scene
/// carry it into others alike: a circle that is shifted, seen from the frame that turns, vibrates for ever.
///
/// An energy that linear terms conserve proves nothing where terms of higher order feed it: x'' = -x + v^3.
/// Where some modes do not decay, forces without a potential must do no work of velocities and have no
/// circulation along those modes at finite displacements, up to a hundredth of the scene's length; else the
/// verdict is undecided. (In some states, so this is no proof; and not of forces that read multipliers.)
///
/// Up to 600 coordinates by dense matrices: all modes. Beyond that the `lowest`, by shift and invert with
/// memory in proportion to the size of the scene: Lanczos' method if (1) is symmetric and undamped, else
/// Arnoldi's on the quadratic problem, each pair checked in (1). Runs from new vectors, deflated by what is
/// known, until one finds nothing as low: no proof that none is missed. The verdict is then of all modes only
/// where an energy proves it: forces with a potential, H + M A^2 positive, damping that adds no energy. Where
/// it does not, it is unstable if a mode that was found surely grows, else undecided, and says of how many
/// modes it is. Not for nonholonomic constraints.
///
/// Uncoupled parts of a scene are judged separately. The numbers of a part's K are known to round-off of the
/// terms that they sum: within that an eigenvalue is undecided, or 0 and tried.
///
/// The equilibrium may be that of a copy of the scene. Throws InvalidArgument if it is not one of this scene
/// as it is now, InvalidScene if `lowest` is not suitable or its equations change with time.
template <int D>
[[nodiscard]] NormalModes<D> normal_modes(const Scene<D>& scene, const Equilibrium<D>& equilibrium,
                                          const ModesOptions& options = {}) {
  const System system = scene.system();
  if (!detail::same_elements(*system.layout(), equilibrium.layout()))
    throw InvalidArgument("This equilibrium belongs to another scene than \"" + scene.name() + '"');
  return {system.layout(),
          find_modes(system, equilibrium.record(), equilibrium.turning(), options, equilibrium.motion()),
          equilibrium.left_out()};
}

}  // namespace dalembert

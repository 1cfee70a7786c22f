// A picture of my scene that moves, with its forces.
#include <dalembert/dalembert.h>
#include <dalembert/view/write_html.h>

#include <cmath>

int main() {
  using namespace dalembert;
  Scene<2> scene("swing");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto seat = scene.add_particle({.mass = 30.0, .position = {1.0, -2.0}}, "seat");
  scene.add(unilateral(Distance{Fixed<2>{}, seat, std::sqrt(5.0)}, {.allowed = Allowed::negative}), "rope");

  write_html(certify(scene, {.t_end = 10.0, .samples = 1001}), "swing.html", {.units = {"m", "s", "N"}});
}

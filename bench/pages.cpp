#include <dalembert/bench/commands.h>
#include <dalembert/bench/models.h>
#include <dalembert/bench/progress.h>
#include <dalembert/bench/table.h>
#include <dalembert/models/lecture_scenes.h>
#include <dalembert/view/write_html.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>

namespace dalembert::bench {

namespace {

/// All models are in these.
const PageOptions::Units units{"m", "s", "N"};

void write_table(const std::string& path, const Table& table) {
  std::ofstream file(path);
  table.write_csv(file);
  if (!file.flush()) throw Error(path + " could not be written: does its folder exist?");
}

/// A model's run, as a table beside its hand derivation.
template <int D>
class Motion {
 public:
  Motion(const models::Model<D>& model, const models::Observed<D>& observed,
         const Certificate<D>& certificate)
      : model_(model),
        observed_(observed),
        certificate_(certificate),
        reference_(model.observations(certificate.run().times())),
        points_(reference_.front().positions.size()),
        forces_(reference_.front().forces.size()) {}

  [[nodiscard]] Table table() const {
    Table table{.columns = columns(), .rows = {}};
    for (std::size_t i = 0; i < reference_.size(); ++i) table.rows.push_back(row(i));
    return table;
  }

 private:
  [[nodiscard]] std::vector<std::string> columns() const {
    std::vector<std::string> names = {"t"};
    const auto add = [&](const std::string& name) { names.insert(names.end(), {name, name + ".reference"}); };
    for (std::size_t k = 1; k <= points_; ++k) {
      for (int axis = 0; axis < D; ++axis) add("position" + std::to_string(k) + '.' + "xyz"[axis]);
    }
    for (std::size_t k = 1; k <= forces_; ++k) add("force" + std::to_string(k));
    names.insert(names.end(), {"error_position", "estimated_position", "error_force", "estimated_force"});
    return names;
  }

  [[nodiscard]] std::vector<std::string> row(std::size_t i) const {
    const auto seen = observed_.observe(certificate_.run().sample(i));
    const models::Observation<D>& due = reference_[i];
    std::vector<std::string> cells = {scientific(certificate_.run().times()[i], 10)};
    const auto add = [&](double a, double b) {
      cells.insert(cells.end(), {scientific(a, 10), scientific(b, 10)});
    };
    for (std::size_t k = 0; k < points_; ++k) {
      for (int axis = 0; axis < D; ++axis) add(seen.positions[k][axis], due.positions[k][axis]);
    }
    for (std::size_t k = 0; k < forces_; ++k) add(seen.forces[k], due.forces[k]);
    double position = 0.0, estimated_position = 0.0, force = 0.0, estimated_force = 0.0;
    for (std::size_t k = 0; k < points_; ++k) {
      position = std::max(position, (seen.positions[k] - due.positions[k]).norm());
      const auto read = [&](const Sample<D>& now) { return observed_.observe(now).positions[k]; };
      estimated_position = std::max(estimated_position, certificate_.error(read, i));
    }
    for (std::size_t k = 0; k < forces_; ++k) {
      if (std::isnan(seen.forces[k])) continue;  // not determined there
      force = std::max(force, std::abs(seen.forces[k] - due.forces[k]));
      const auto read = [&](const Sample<D>& now) { return observed_.observe(now).forces[k]; };
      estimated_force = std::max(estimated_force, certificate_.error(read, i));
    }
    add(position / model_.length, estimated_position / model_.length);
    add(force / model_.force, estimated_force / model_.force);
    return cells;
  }

  const models::Model<D>& model_;
  const models::Observed<D>& observed_;
  const Certificate<D>& certificate_;
  std::vector<models::Observation<D>> reference_;
  std::size_t points_, forces_;
};

template <int D>
void write_model(const models::Model<D>& model, const PagesOptions& options) {
  const models::Observed<D> observed = model.scene();
  const auto certificate = certify(observed.scene, {.t_end = model.t_end,
                                                    .samples = options.samples,
                                                    .tolerance = options.tolerance,
                                                    .stepper = options.stepper});
  const std::string path = options.directory + '/' + model.name;
  write_table(path + "-motion.csv", Motion<D>(model, observed, certificate).table());
  write_html(certificate, path + ".html", {.title = model.name, .units = units});
}

/// A run whose events have times in closed form.
void write_event_model(const models::EventModel& model, const PagesOptions& options) {
  std::optional<TwoRuns> runs;
  (void)model.events({.stepper = options.stepper,
                      .tolerance = options.tolerance,
                      .certified = &runs,
                      .samples = options.samples});
  const std::string path = options.directory + '/' + model.name + ".html";
  if (runs->run()->layout->dimension == 2) {
    write_html(Certificate<2>(*runs), path, {.title = model.name, .units = units});
  } else {
    write_html(Certificate<3>(*runs), path, {.title = model.name, .units = units});
  }
}

template <int D>
void write_scene(const Scene<D>& scene, double t_end, const PagesOptions& options) {
  const auto certificate = certify(scene, {.t_end = t_end,
                                           .samples = options.samples,
                                           .tolerance = options.tolerance,
                                           .stepper = options.stepper});
  write_html(certificate, options.directory + '/' + scene.name() + ".html",
             {.title = scene.name(), .units = units});
}

}  // namespace

void pages(const PagesOptions& options) {
  const auto selected = select_models(options.models);
  Table list{.columns = {"model", "notes", "reference", "t_end", "stepper", "tolerance", "outcome"},
             .rows = {}};
  const std::string path = options.directory + "/models.csv";
  write_table(path, list);  // better now than after the runs
  Progress progress(selected.size());
  for (const models::AnyModel& any : selected) {
    std::visit(
        [&](const auto& model) {
          progress.next(model.name);
          const Outcome outcome = attempt(model.name, [&] { write_model(model, options); });
          list.rows.push_back({model.name, model.notes, model.reference, shortest(model.t_end),
                               name(options.stepper), shortest_power(options.tolerance), outcome.name});
        },
        any);
  }
  write_table(path, list);
  if (std::ranges::find(options.models, "all") == options.models.end()) return;
  for (const models::EventModel& model : models_of_events())
    attempt(model.name, [&] { write_event_model(model, options); });
  for (const auto& [scene, t_end] : models::lecture_scenes())
    std::visit(
        [&, end = t_end](const auto& own) { attempt(own.name(), [&] { write_scene(own, end, options); }); },
        scene);
}

}  // namespace dalembert::bench

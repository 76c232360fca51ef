#include "tumble/batch/drop_measures.hpp"
#include "tumble/batch/rollout.hpp"
#include "tumble/sweep/models.hpp"

namespace tumble::sweep {
namespace {

// What the rollout takes.
class Inputs {
 public:
  explicit Inputs(const SliceValues& values) : values_(values) {
    const SceneModel& model = *values.spec.scene;
    const std::vector<int> bodies = batch::movable_bodies(model.scene);
    for (std::size_t i = 0; i < values.count; ++i) {
      for (const int body : bodies) {
        const auto& [position, angle] = model.scene.bodies[static_cast<std::size_t>(body)].pose;
        pose_.insert(pose_.end(), {position.x, position.y, angle});
        const Vector3& velocity = model.scene.bodies[static_cast<std::size_t>(body)].velocity;
        velocity_.insert(velocity_.end(), {velocity[0], velocity[1], velocity[2]});
      }
    }
    instances_ = {values.count, pose_, velocity_, {}};
    for (std::size_t k = 0; k < values.values.size(); ++k) put(values.spec.quantities[k].target, k, bodies.size());
    instances_.pose = pose_;
    instances_.velocity = velocity_;
  }

  const batch::Instances& instances() const { return instances_; }

 private:
  void put(const SceneTarget& target, std::size_t quantity, std::size_t num_bodies) {
    const std::vector<double>& column = values_.values[quantity];
    if (target.kind == SceneTarget::Kind::varied) {
      instances_.varied.push_back({target.quantity, target.index, column});
      return;
    }
    std::vector<double>& rows = target.kind == SceneTarget::Kind::pose ? pose_ : velocity_;
    for (std::size_t i = 0; i < values_.count; ++i) {
      rows[3 * (i * num_bodies + static_cast<std::size_t>(target.index)) +
           static_cast<std::size_t>(target.coordinate)] = column[column.size() == 1 ? 0 : i];
    }
  }

  const SliceValues& values_;
  std::vector<double> pose_, velocity_;
  batch::Instances instances_;
};

batch::DropStatus status_of(LcpStatus status) {
  if (status == LcpStatus::solved) return batch::DropStatus::solved;
  return status == LcpStatus::bad_input ? batch::DropStatus::invalid : batch::DropStatus::numerical;
}

}  // namespace

Rows simulate_scenes(const SliceValues& values, const std::function<void()>& watch) {
  const Inputs inputs(values);
  const SceneModel& model = *values.spec.scene;
  batch::RolloutSettings settings;
  settings.threads = 1;
  settings.measures = values.spec.measures;
  settings.watch = [&](std::size_t) { watch(); };
  const std::size_t num_bodies = batch::movable_bodies(model.scene).size();
  std::vector<double> pose(3 * num_bodies * values.count);
  std::vector<LcpStatus> status(values.count);
  std::vector<batch::RolloutMeasures> measures(values.count);
  batch::rollout(model.scene, inputs.instances(), settings, {pose, {}, status, measures});

  Rows rows;
  for (std::size_t i = 0; i < values.count; ++i) {
    const double* end = &pose[3 * (i * num_bodies + static_cast<std::size_t>(model.body))];
    rows.pose.insert(rows.pose.end(), end, end + 3);
    rows.status.push_back(status_of(status[i]));
    const bool is_solved = status[i] == LcpStatus::solved;
    const batch::RolloutMeasures& told = measures[i];
    rows.measures.push_back({told.last_contact, told.rest_time, told.max_impulse, told.energy_lost, told.escape_time,
                             static_cast<std::int32_t>(told.impacts), is_solved ? batch::face_up(end[2]) : -1});
  }
  return rows;
}

Path scene_path(const SliceValues& values, int every) {
  const Inputs inputs(values);
  const SceneModel& model = *values.spec.scene;
  batch::RolloutSettings settings;
  settings.threads = 1;
  settings.every = every;
  Path path{batch::sample_times(model.scene, settings), {}};
  const std::size_t num_bodies = batch::movable_bodies(model.scene).size();
  std::vector<double> pose(3 * num_bodies * values.count * path.time.size());
  batch::rollout(model.scene, inputs.instances(), settings, {pose, {}, {}, {}});
  const auto first =
      pose.begin() + static_cast<std::ptrdiff_t>(3 * static_cast<std::size_t>(model.body) * path.time.size());
  path.x.assign(first, first + static_cast<std::ptrdiff_t>(path.time.size()));
  return path;
}

}  // namespace tumble::sweep

// What makes a scene that of one instance. Not a public header.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tumble/batch/rollout.hpp"

namespace tumble::batch {

// Of a valid scene. Refers to both, which must outlive it.
class InstanceEditor {
 public:
  // Throws std::invalid_argument for arrays of wrong lengths and indices that name nothing.
  InstanceEditor(const Scene& scene, const Instances& instances);

  // Throws std::invalid_argument, naming it, for a value common to all instances that is out of range.
  void require_common_in_range() const;

  // Makes a copy of the scene, or of an instance, that of instance i.
  void edit(std::size_t i, Scene& scene) const;

  // As `validate` judges an instance.
  bool is_valid(const Scene& instance) const;

  const std::vector<int>& bodies() const { return bodies_; }
  const std::vector<int>& masses() const { return masses_; }  // bodies whose masses are edited
  bool edits_laws() const { return !laws_.empty(); }

 private:
  // What gives the moment of inertia of a mass.
  struct MassRatio {
    double mass = 1.0, moment_of_inertia = 1.0;
  };

  void check_varied(const Varied& varied) const;
  std::string name_of(const Varied& varied) const;
  static MassRatio ratio_of(const Body& body);
  bool has_own(std::span<const double> starts) const { return starts.size() == instances_.count * width_; }
  void set_starts(std::size_t pose_row, std::size_t velocity_row, Scene& scene) const;
  void set(std::size_t k, double value, Scene& scene) const;

  const Scene& scene_;
  const Instances& instances_;
  std::vector<int> bodies_;
  std::size_t width_;               // numbers of a start
  std::vector<Varied> varied_;      // in the order in which they are set
  std::vector<MassRatio> ratios_;   // of these, where they are masses
  std::vector<int> masses_, laws_;  // bodies and laws that are edited
};

}  // namespace tumble::batch

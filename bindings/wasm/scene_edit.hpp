// A scene as the page shows and changes it. Scenes travel as text; objects have the names of tumble.d.mts.
#pragma once

#include "convert.hpp"

#include "tumble/scene/scene.hpp"

namespace tumble::wasm {

// Everything that is drawn or has a control.
val describe(const Scene& scene);

// Applies the changes of an object {bodies: [{index, pose, velocity, mass}], materials: [{index, friction,
// restitution}], gravity, step_size, duration}, whatever of it is there. Throws std::invalid_argument as `validate`.
void apply_edits(Scene& scene, const val& edits);

}  // namespace tumble::wasm

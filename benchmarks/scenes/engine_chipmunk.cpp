// Chipmunk 7.
#include "engine.hpp"

#ifdef TUMBLE_HAS_CHIPMUNK

#include <cmath>
#include <memory>

#include <chipmunk/chipmunk.h>

#include "tumble/math/format.hpp"

namespace tumble::bench {
namespace {

cpVect to_cp(Vector2 a) { return cpv(a.x, a.y); }

class ChipmunkWorld {
 public:
  ChipmunkWorld(const World& world, int iterations)
      : space_(cpSpaceNew()), friction_(std::sqrt(world.friction)), restitution_(std::sqrt(world.restitution)) {
    cpSpaceSetGravity(space_, cpv(0.0, -world.gravity));
    cpSpaceSetIterations(space_, iterations);
    // The overlap that is not corrected. The default, 0.1 m, is meant for bodies of some pixels and is half a box here.
    cpSpaceSetCollisionSlop(space_, 0.5e-3);
    for (const Outline& wall : world.walls) add_shape(cpSpaceGetStaticBody(space_), wall);
    for (const WorldBody& body : world.bodies) {
      cpBody* b = cpSpaceAddBody(space_, cpBodyNew(body.mass, body.moment_of_inertia));
      cpBodySetPosition(b, to_cp(body.pose.position));
      cpBodySetAngle(b, body.pose.angle);
      cpBodySetVelocity(b, cpv(body.velocity[0], body.velocity[1]));
      cpBodySetAngularVelocity(b, body.velocity[2]);
      bodies_.push_back(b);
      add_shape(b, body.outline);
    }
  }

  ~ChipmunkWorld() {
    for (cpShape* shape : shapes_) {
      cpSpaceRemoveShape(space_, shape);
      cpShapeFree(shape);
    }
    for (cpBody* body : bodies_) {
      cpSpaceRemoveBody(space_, body);
      cpBodyFree(body);
    }
    cpSpaceFree(space_);
  }

  ChipmunkWorld(const ChipmunkWorld&) = delete;
  ChipmunkWorld& operator=(const ChipmunkWorld&) = delete;

  void advance(int count, double step_size) {
    for (int i = 0; i < count; ++i) cpSpaceStep(space_, step_size);
  }

  Motion motion(int body) const {
    const cpBody* b = bodies_[static_cast<std::size_t>(body)];
    const cpVect x = cpBodyGetPosition(b), v = cpBodyGetVelocity(b);
    return {{{x.x, x.y}, cpBodyGetAngle(b)}, {v.x, v.y, cpBodyGetAngularVelocity(b)}};
  }

  int num_contacts() const {
    struct {
      int of_walls = 0;
      int of_bodies = 0;  // counted from both of them
    } count;
    const auto add = [](cpBody* body, cpArbiter* arbiter, void* data) {
      cpBody *a = nullptr, *b = nullptr;
      cpArbiterGetBodies(arbiter, &a, &b);
      const bool is_wall = cpBodyGetType(a == body ? b : a) != CP_BODY_TYPE_DYNAMIC;
      auto& counted = *static_cast<decltype(count)*>(data);
      (is_wall ? counted.of_walls : counted.of_bodies) += cpArbiterGetCount(arbiter);
    };
    for (cpBody* body : bodies_) cpBodyEachArbiter(body, add, &count);
    return count.of_walls + count.of_bodies / 2;
  }

 private:
  void add_shape(cpBody* body, const Outline& outline) {
    cpShape* shape = nullptr;
    if (outline.vertices.size() == 1) {
      shape = cpCircleShapeNew(body, outline.radius, to_cp(outline.vertices[0]));
    } else {
      std::vector<cpVect> vertices;
      for (const Vector2& p : outline.vertices) vertices.push_back(to_cp(p));
      shape = cpPolyShapeNewRaw(body, static_cast<int>(vertices.size()), vertices.data(), 0.0);
    }
    // Chipmunk multiplies the coefficients of two shapes: hence the roots.
    cpShapeSetFriction(shape, friction_);
    cpShapeSetElasticity(shape, restitution_);
    shapes_.push_back(cpSpaceAddShape(space_, shape));
  }

  cpSpace* space_;
  double friction_, restitution_;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;
};

Engine chipmunk(int iterations) {
  const auto build = [=](const World& world, double step_size) {
    const auto shared = std::make_shared<ChipmunkWorld>(world, iterations);
    return Run{[=](int count) { shared->advance(count, step_size); }, [=](int body) { return shared->motion(body); },
               [=] { return shared->num_contacts(); }};
  };
  return {"Chipmunk 7", tumble::format("{} iterations", iterations),
          "computes in double and corrects overlap down to 0.5 mm: its slop, set here, as the default is 0.1 m. Debian "
          "compiles it with its assertions, without which it takes some 5 to 20 % less time",
          build};
}

}  // namespace

std::vector<Engine> chipmunk_engines() { return {chipmunk(10), chipmunk(100)}; }

}  // namespace tumble::bench

#else

namespace tumble::bench {

std::vector<Engine> chipmunk_engines() { return {}; }

}  // namespace tumble::bench

#endif

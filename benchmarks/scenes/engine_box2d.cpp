// Box2D 2.4. Float and the skin around polygons (b2_polygonRadius) are fixed when the library is compiled.
#include "engine.hpp"

#ifdef TUMBLE_HAS_BOX2D

#include <memory>

#include <box2d/box2d.h>

#include "tumble/math/format.hpp"

namespace tumble::bench {
namespace {

b2Vec2 to_b2(Vector2 a) { return {static_cast<float>(a.x), static_cast<float>(a.y)}; }

struct Surface {
  float friction = 0.0f;  // Box2D takes the geometric mean of two: that of the world, for all of one kind
  float restitution = 0.0f;
  float restitution_threshold = 0.0f;  // [m/s]
};

void add_fixture(b2Body& body, const Outline& outline, const Surface& surface) {
  b2PolygonShape polygon;
  b2CircleShape circle;
  b2FixtureDef fixture;
  if (outline.vertices.size() == 1) {
    circle.m_p = to_b2(outline.vertices[0]);
    circle.m_radius = static_cast<float>(outline.radius);
    fixture.shape = &circle;
  } else {
    std::vector<b2Vec2> vertices;
    for (const Vector2& p : outline.vertices) vertices.push_back(to_b2(p));
    polygon.Set(vertices.data(), static_cast<int32>(vertices.size()));
    fixture.shape = &polygon;
  }
  fixture.friction = surface.friction;
  fixture.restitution = surface.restitution;
  fixture.restitutionThreshold = surface.restitution_threshold;
  body.CreateFixture(&fixture);
}

// The world frees its bodies.
struct Box2dWorld {
  b2World world;
  std::vector<b2Body*> bodies;

  Box2dWorld(const World& w, double step_size) : world(b2Vec2(0.0f, static_cast<float>(-w.gravity))) {
    world.SetAllowSleeping(false);
    // Below the speed of two steps of fall nothing bounces: 1 m/s, the default, would end these bounces early.
    const Surface surface{static_cast<float>(w.friction), static_cast<float>(w.restitution),
                          static_cast<float>(2.0 * w.gravity * step_size)};
    const b2BodyDef fixed_body;
    b2Body* fixed = world.CreateBody(&fixed_body);
    for (const Outline& wall : w.walls) add_fixture(*fixed, wall, surface);
    for (const WorldBody& body : w.bodies) {
      b2BodyDef definition;
      definition.type = b2_dynamicBody;
      definition.position = to_b2(body.pose.position);
      definition.angle = static_cast<float>(body.pose.angle);
      definition.linearVelocity = to_b2({body.velocity[0], body.velocity[1]});
      definition.angularVelocity = static_cast<float>(body.velocity[2]);
      bodies.push_back(world.CreateBody(&definition));
      add_fixture(*bodies.back(), body.outline, surface);
      const b2MassData mass{static_cast<float>(body.mass), b2Vec2_zero, static_cast<float>(body.moment_of_inertia)};
      bodies.back()->SetMassData(&mass);
    }
  }

  Motion motion(int body) const {
    const b2Body& b = *bodies[static_cast<std::size_t>(body)];
    const b2Vec2 x = b.GetWorldCenter(), v = b.GetLinearVelocity();
    return {{{x.x, x.y}, b.GetAngle()}, {v.x, v.y, b.GetAngularVelocity()}};
  }

  int num_contacts() const {
    int count = 0;
    for (const b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
      if (c->IsTouching()) count += c->GetManifold()->pointCount;
    }
    return count;
  }
};

Engine box2d(int velocity_iterations, int position_iterations) {
  const auto build = [=](const World& world, double step_size) {
    const auto shared = std::make_shared<Box2dWorld>(world, step_size);
    const auto advance = [=](int count) {
      for (int i = 0; i < count; ++i) {
        shared->world.Step(static_cast<float>(step_size), velocity_iterations, position_iterations);
      }
    };
    return Run{advance, [=](int body) { return shared->motion(body); }, [=] { return shared->num_contacts(); }};
  };
  return {"Box2D 2.4", tumble::format("{}/{} iterations", velocity_iterations, position_iterations),
          "computes in float; polygons have a skin of 10 mm, so that they come to rest about 15 mm apart and show no "
          "overlap before the skins are used up",
          build};
}

}  // namespace

std::vector<Engine> box2d_engines() { return {box2d(8, 3), box2d(100, 50)}; }

}  // namespace tumble::bench

#else

namespace tumble::bench {

std::vector<Engine> box2d_engines() { return {}; }

}  // namespace tumble::bench

#endif

// The tables of a run, read back.
#include <limits>

#include "record_samples.hpp"

#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::output {
namespace {

using test::has;

struct Tables {
  std::string samples, contacts;
};

Tables tables_of(const Trajectory& run) {
  return {samples_csv_header(run) + samples_csv_rows(run, 0, run.time.size()),
          contacts_csv_header(run) + contacts_csv_rows(run, 0, run.contacts.size())};
}

Trajectory read(const Scene& scene, const Tables& tables) {
  return parse_trajectory_csv(scene, tables.samples, "run.csv", tables.contacts, "run.contacts.csv");
}

Trajectory run_of(const std::string& name, double duration, int sample_every = 1) {
  const std::string file = std::string(TUMBLE_SOURCE) + "/scenes/" + name + ".toml";
  SimulateSettings settings;
  settings.duration = duration;
  settings.sample_every = sample_every;
  return simulate(parse_scene(read_file(file, 1'000'000), name), settings);
}

// Two bodies with names that need quotes, one without a name; two steps.
const Trajectory& small_run() {
  static const Trajectory run = simulate(parse_scene(R"(
    tumble = 1
    title = "Two, at \"rest\""
    gravity = [0, -8]
    step_size = 0.125
    duration = 0.25
    bodies = [
      { name = "floor", kind = "fixed", shape = { half_plane = [0, 1] } },
      { name = 'the "ball", red', shape = { disc = 0.25 }, mass = 1, position = [0, 0.25] },
      { shape = { disc = 0.25 }, mass = 1, position = [3, 0.25] },
      { name = '"', kind = "kinematic", shape = { disc = 1 }, position = [5, 5], velocity = [1, 0] },
    ])"));
  return run;
}

void expect_same_records(const ContactRecord& a, const ContactRecord& b) {
  EXPECT_EQ(a.contact.body_a, b.contact.body_a);
  EXPECT_EQ(a.contact.body_b, b.contact.body_b);
  EXPECT_EQ(a.contact.feature, b.contact.feature);
  EXPECT_EQ(a.contact.point_a, b.contact.point_a);
  EXPECT_EQ(a.contact.normal, b.contact.normal);
  EXPECT_EQ(a.law, b.law);
  EXPECT_EQ(a.normal_impulse, b.normal_impulse);
  EXPECT_EQ(a.friction_impulse, b.friction_impulse);
  EXPECT_EQ(a.tangential_velocity_after, b.tangential_velocity_after);
  EXPECT_EQ(a.mode, b.mode);
}

void expect_same_runs(const Trajectory& a, const Trajectory& b) {
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.step_size, b.step_size);
  EXPECT_TRUE(test::same_bits(a.time, b.time));
  EXPECT_EQ(a.num_steps, b.num_steps);
  EXPECT_EQ(a.is_complete, b.is_complete);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    EXPECT_EQ(a.states[i].pose, b.states[i].pose) << i;
    EXPECT_EQ(a.states[i].velocity, b.states[i].velocity) << i;
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    EXPECT_EQ(a.contacts[k].step, b.contacts[k].step);
    ASSERT_EQ(a.contacts[k].contacts.size(), b.contacts[k].contacts.size());
    for (std::size_t i = 0; i < a.contacts[k].contacts.size(); ++i) {
      expect_same_records(a.contacts[k].contacts[i], b.contacts[k].contacts[i]);
    }
  }
}

void expect_round_trip(const Trajectory& run) {
  const Tables tables = tables_of(run);
  const Trajectory again = read(run.scene, tables);
  expect_same_runs(again, run);
  EXPECT_TRUE(tables_of(again).samples == tables.samples);
  EXPECT_TRUE(tables_of(again).contacts == tables.contacts);
}

TEST(TrajectoryRead, NamedScenesComeBackToTheSameBits) {
  for (const char* name : {"drop", "compound", "tilting_table", "conveyor", "newtons_cradle", "dominoes"}) {
    SCOPED_TRACE(name);
    const Trajectory run = run_of(name, 0.8, 7);
    ASSERT_GT(run.contacts.size(), 0u);
    expect_round_trip(run);
  }
}

TEST(TrajectoryRead, NamesInQuotesComeBack) {
  ASSERT_TRUE(has(tables_of(small_run()).contacts, R"("the ""ball"", red")"));
  ASSERT_EQ(small_run().contacts.at(0).contacts.size(), 2u);
  expect_round_trip(small_run());
}

TEST(TrajectoryRead, FilesOfTheFirstVersionAreRead) {
  const auto text = [](const std::string& ending) {
    return read_file(std::string(TUMBLE_SOURCE) + "/tests/output/data/two_balls." + ending, 10'000);
  };
  const Trajectory run = read(parse_scene(text("toml")), {text("csv"), text("contacts.csv")});
  EXPECT_EQ(run.num_steps, 2);
  EXPECT_EQ(run.bodies(2)[1].pose.position, (Vector2{0.0, 0.25}));
  EXPECT_EQ(run.contacts.at(1).contacts.at(0).normal_impulse, 0.125 * 9.81);
}

TEST(TrajectoryRead, TheDropComesBack) { expect_round_trip(trajectory_of(test::course_record())); }

TEST(TrajectoryRead, RunsThatEndedEarlyAndNumbersAtTheEndsOfTheRangeComeBack) {
  Trajectory run = small_run();
  run.status = LcpStatus::iteration_limit;
  run.residual = std::numeric_limits<double>::infinity();
  run.is_complete = false;
  run.created_energy = 5e-324;
  run.states[1].pose.position = {-0.0, 1e300};
  run.contacts[0].contacts[0].contact.gap = -0.0;
  run.contacts[0].contacts[0].contact.feature = 4294967295u;
  const Tables tables = tables_of(run);
  const Trajectory again = read(run.scene, tables);
  EXPECT_EQ(again.status, run.status);
  EXPECT_TRUE(tables_of(again).samples == tables.samples);
  EXPECT_TRUE(tables_of(again).contacts == tables.contacts);
}

TEST(TrajectoryRead, WhatIsInNoTableIsDerived) {
  const Trajectory& run = small_run();
  const Trajectory again = read(run.scene, tables_of(run));
  const ContactRecord& contact = again.contacts.at(0).contacts.at(0);
  EXPECT_EQ(contact.tangent, (Vector2{1.0, 0.0}));
  EXPECT_EQ(contact.place_a, contact.contact.point_a);
  EXPECT_EQ(contact.place_b, contact.contact.point_b);
  EXPECT_EQ(again.bodies(2)[0].pose, run.scene.bodies[0].pose);
}

TEST(TrajectoryRead, ContactsMayBeLeftOutAndLinesMayEndAsOnWindows) {
  const Trajectory& run = small_run();
  std::string text;
  for (const char c : tables_of(run).samples) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Trajectory again = parse_trajectory_csv(run.scene, text, "run.csv");
  EXPECT_EQ(tables_of(again).samples, tables_of(run).samples);
  EXPECT_TRUE(again.contacts.empty());
}

std::string refusal(const Tables& tables) {
  return test::message_of<std::invalid_argument>([&] { read(small_run().scene, tables); });
}

Tables replaced(const std::string& from, const std::string& to, std::string Tables::*table) {
  Tables tables = tables_of(small_run());
  const std::size_t at = (tables.*table).find(from);
  EXPECT_NE(at, std::string::npos) << from;
  (tables.*table).replace(at, from.size(), to);
  return tables;
}

TEST(TrajectoryRead, RefusesBadSamplesWithThePlace) {
  const auto message = [](const std::string& from, const std::string& to) {
    return refusal(replaced(from, to, &Tables::samples));
  };
  EXPECT_EQ(message("# tumble samples 1", "# tumble samples 2"),
            "run.csv:1:1: expected '# tumble samples 1', got '# tumble samples 2'");
  EXPECT_EQ(message("Two, at", "Six, at"),
            "run.csv:2:1: expected '# title = Two, at \"rest\"', got '# title = Six, at \"rest\"'");
  EXPECT_EQ(message("0.125 s", "0 s"), "run.csv:3:1: step_size: must be finite and > 0, got 0");
  EXPECT_EQ(message("0.125 s", "fast s"), "run.csv:3:15: step_size: expected a number, got 'fast'");
  EXPECT_EQ(message("steps = 2", "steps = 1e1"),
            "run.csv:4:11: steps: must be a whole number in [0, 1000000000], got '1e1'");
  EXPECT_TRUE(has(message("= solved", "= done"), "run.csv:5:12: status: must be one of solved, "));
  EXPECT_EQ(message("residual = ", "residual = x"), "run.csv:6:14: residual: expected a number, got 'x0'");
  EXPECT_EQ(message("complete = yes", "complete = maybe"),
            "run.csv:7:14: complete: must be one of yes, no, got 'maybe'");
  EXPECT_EQ(message(" J\n", " N\n"),
            "run.csv:8:1: expected '# created_energy = VALUE J', got '# created_energy = 0 N'");
  EXPECT_EQ(message("samples = 3", "samples = 4"), "run.csv:9:13: samples: must be a whole number in [1, 3], got '4'");
  EXPECT_EQ(message("samples = 3", "samples = 2"), "run.csv:13:1: expected the end of the file after 2 rows");
  EXPECT_EQ(message("\"the \"\"ball\"\", red.y [m]\"", "ball.y [m]"),
            "run.csv:10:163: column 11: expected '\"the \"\"ball\"\", red.y [m]\"', got 'ball.y [m]'");
  EXPECT_TRUE(has(message(".omega [rad/s]\"\n", ".omega [rad/s]\",z\n"), "column 28: expected no more, got 'z'"));
  EXPECT_TRUE(
      has(message(",created [J]", ""), "column 9: expected 'created [J]', got '\"the \"\"ball\"\", red.x [m]\"'"));
  EXPECT_EQ(message("\n0.125,0,", "\n0,0,"), "run.csv:12:1: t: must be > 0, got '0'");
  EXPECT_EQ(message("\n0,0,", "\n0.5,0,"), "run.csv:11:1: t: must be 0, the start, got '0.5'");
  EXPECT_EQ(message("\n0.125,0,", "\n0.125,inf,"), "run.csv:12:7: kinetic: must be finite, got 'inf'");
  EXPECT_EQ(message("\n0.125,0,", "\n0.125,"), "run.csv:12:1: expected 27 columns, got 26");
  EXPECT_EQ(message("\n0.125,0,", "\n\"0.125,0,"),
            "run.csv:12:1: a cell starts with a quote and does not end with one");
  EXPECT_EQ(message("0.25,0,0,0,0,3", "0.25,0,0,up,0,3"),
            "run.csv:11:30: the \"ball\", red.vy: expected a number, got 'up'");
}

TEST(TrajectoryRead, RefusesBadContactsWithThePlace) {
  const auto message = [](const std::string& from, const std::string& to) {
    return refusal(replaced(from, to, &Tables::contacts));
  };
  EXPECT_EQ(message("# tumble contacts 1", "# tumble samples 1"),
            "run.contacts.csv:1:1: expected '# tumble contacts 1', got '# tumble samples 1'");
  EXPECT_EQ(message("steps = 2", "steps = 3"), "run.contacts.csv:4:1: expected '# steps = 2', got '# steps = 3'");
  EXPECT_EQ(message("part_b", "part_c"), "run.contacts.csv:9:33: column 6: expected 'part_b', got 'part_c'");
  EXPECT_EQ(message("\n1,0.125", "\n3,0.125"),
            "run.contacts.csv:10:1: step: must be a whole number in [1, 2], got '3'");
  EXPECT_EQ(message("\n1,0.125", "\n2,0.25"), "run.contacts.csv:11:1: step: must be 2, got '1'");
  EXPECT_EQ(message("\n1,0.125", "\n1,0.25"),
            "run.contacts.csv:10:3: t: must be step times step_size = 0.125, got '0.25'");
  EXPECT_EQ(message(",floor,", ",flour,"),
            "run.contacts.csv:10:9: body_a: must be the name of a body of the scene, got 'flour'");
  EXPECT_EQ(message("\"the \"\"ball\"\", red\"", "floor"),
            "run.contacts.csv:10:15: body_b: must stand behind body_a in the scene, got 'floor'");
  EXPECT_EQ(message("red\",0,0", "red\",1,0"), "run.contacts.csv:10:35: part_a: must be 0, got '1'");
  EXPECT_EQ(message("red\",0,0,", "red\",0,0,-"),
            "run.contacts.csv:10:39: feature: must be a whole number in [0, 4294967295], got '-65536'");
  EXPECT_EQ(message(",stick,", ",stuck,"),
            "run.contacts.csv:10:45: mode: must be one of open, stick, slip left, slip right, got 'stuck'");
  EXPECT_EQ(message(",stick,0,", ",stick,nan,"), "run.contacts.csv:10:51: x_a: must be finite, got 'nan'");
  EXPECT_TRUE(
      has(refusal({tables_of(small_run()).samples, "x"}), "run.contacts.csv:1:2: the file ends here, expected"));
}

TEST(TrajectoryRead, RefusesABadScene) {
  Scene scene = small_run().scene;
  scene.bodies[1].mass = -1.0;
  EXPECT_THROW(read(scene, tables_of(small_run())), std::invalid_argument);
}

TEST(TrajectoryRead, RefusesMoreSamplesThanTheTextCanHold) {
  Tables tables = replaced("steps = 2", "steps = 1000000000", &Tables::samples);
  tables.samples.replace(tables.samples.find("samples = 3"), 11, "samples = 1000000001");
  EXPECT_EQ(refusal(tables),
            "run.csv:9:1: samples: 1000000001 rows are announced, but the file is too short for them: was it cut off?");
}

// Contacts have no count in front: cut between two rows, they are fewer.
TEST(TrajectoryRead, RefusesTruncation) {
  const Tables tables = tables_of(small_run());
  for (std::size_t size = 1; size < tables.samples.size(); ++size) {
    EXPECT_NE(refusal({tables.samples.substr(0, size), tables.contacts}), "") << size;
  }
  for (std::size_t size = 1; size < tables.contacts.size(); ++size) {
    const std::string text = tables.contacts.substr(0, size);
    if (text.back() != '\n' || has(text, "law_restitution\n") == false) {
      EXPECT_NE(refusal({tables.samples, text}), "") << size;
    }
  }
}

TEST(TrajectoryRead, AChangedByteIsRefusedInOneLineOrRead) {
  const Tables tables = tables_of(small_run());
  std::size_t refused = 0;
  for (const auto table : {&Tables::samples, &Tables::contacts}) {
    for (std::size_t at = 0; at < (tables.*table).size(); ++at) {
      for (const char c : {'\0', '\n', ',', '"', '\xff', '-', '9'}) {
        Tables changed = tables;
        (changed.*table)[at] = c;
        try {
          read(small_run().scene, changed);
        } catch (const std::invalid_argument& error) {
          ++refused;
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
        }
      }
    }
  }
  EXPECT_GT(refused, 4 * tables.samples.size());
}

// The numbers of a drop's contact, against the corner's velocity and the document's law of restitution.
TEST(DropTrajectory, ContactsHaveTheVelocitiesOfTheCorner) {
  const drop::Record record = test::course_record();
  const Trajectory run = trajectory_of(record);
  ASSERT_GT(run.contacts.size(), 3u);
  for (const StepContacts& step : run.contacts) {
    const int k = static_cast<int>(step.step) - 1;
    const ContactRecord& contact = step.contacts.at(0);
    const auto velocity = [&](const Vector3& v) {  // v + omega x r
      const Vector2 r = contact.contact.point_b - run.bodies(static_cast<std::size_t>(k))[1].pose.position;
      return Vector2{v[0] - v[2] * r.y, v[1] + v[2] * r.x};
    };
    const Vector2 before = velocity(record.trajectory.v_at(k)), after = velocity(record.trajectory.v_at(k + 1));
    constexpr double k_rounding = 1e-13;  // of speeds up to 6 m/s, with r from positions up to 1.5 m
    EXPECT_NEAR(contact.normal_velocity, before.y, k_rounding);
    EXPECT_NEAR(contact.tangential_velocity, before.x, k_rounding);
    EXPECT_NEAR(contact.normal_velocity_after, after.y, k_rounding);
    EXPECT_NEAR(contact.tangential_velocity_after, after.x, k_rounding);
    EXPECT_EQ(contact.restitution, record.parameters.eps);
    // While a force acts, u_n' = -eps u_n: the first row of the LCP is 0.
    EXPECT_NEAR(contact.normal_velocity_after, -0.5 * contact.normal_velocity, 1e-12);
  }
}

}  // namespace
}  // namespace tumble::output

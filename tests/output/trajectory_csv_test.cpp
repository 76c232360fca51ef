#include "tumble/output/trajectory_csv.hpp"

#include "../temporary_folder.hpp"
#include "record_samples.hpp"

#include "tumble/output/file.hpp"
#include "tumble/output/hdf5.hpp"
#include "tumble/output/write.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::output {
namespace {

// A ball of 1 kg, of radius 1/4, on the floor; a step of 1/8 s, gravity 8 m/s^2: every number below is exact.
Trajectory ball_at_rest() {
  Trajectory trajectory = simulate(parse_scene(R"(
    tumble = 1
    title = "A ball, at rest"
    gravity = [0, -8]
    step_size = 0.125
    duration = 0.25
    bodies = [
      { name = "floor", kind = "fixed", shape = { half_plane = [0, 1] } },
      { name = 'the "ball", red', shape = { disc = 0.25 }, mass = 1, position = [0, 0.25] },
      { kind = "kinematic", shape = { disc = 1 }, position = [5, 5], velocity = [1, 0] },
    ])"));
  // Friction is +0 or -0; something else to look for:
  for (StepContacts& step : trajectory.contacts) step.contacts.at(0).friction_impulse = 0.5;
  return trajectory;
}

TEST(TrajectoryCsv, HoldsSamplesAndContactsRowByRow) {
  const Trajectory trajectory = ball_at_rest();
  EXPECT_EQ(samples_csv_header(trajectory) + samples_csv_rows(trajectory, 0, trajectory.time.size()),
            R"(# tumble samples 1
# title = A ball, at rest
# step_size = 0.125 s
# steps = 2
# status = solved
# residual = 0
# complete = yes
# created_energy = 0 J
# samples = 3
t [s],kinetic [J],potential [J],external_work [J],friction_loss [J],impact_loss [J],damping_loss [J],)"
            R"(stabilisation_work [J],created [J],"the ""ball"", red.x [m]","the ""ball"", red.y [m]",)"
            R"("the ""ball"", red.angle [rad]","the ""ball"", red.vx [m/s]","the ""ball"", red.vy [m/s]",)"
            R"("the ""ball"", red.omega [rad/s]",body2.x [m],body2.y [m],body2.angle [rad],body2.vx [m/s],)"
            R"(body2.vy [m/s],body2.omega [rad/s]
0,0,2,0,0,0,0,0,0,0,0.25,0,0,0,0,5,5,0,1,0,0
0.125,0,2,0,0,0,0,0,0,0,0.25,0,0,0,0,5.125,5,0,1,0,0
0.25,0,2,0,0,0,0,0,0,0,0.25,0,0,0,0,5.25,5,0,1,0,0
)");
  EXPECT_EQ(contacts_csv_header(trajectory) + contacts_csv_rows(trajectory, 0, trajectory.contacts.size()),
            R"(# tumble contacts 1
# title = A ball, at rest
# step_size = 0.125 s
# steps = 2
# status = solved
# residual = 0
# complete = yes
# created_energy = 0 J
step,t [s],body_a,body_b,part_a,part_b,feature,mode,x_a [m],y_a [m],x_b [m],y_b [m],normal_x,normal_y,gap [m],)"
            R"(normal_velocity [m/s],tangential_velocity [m/s],normal_velocity_after [m/s],)"
            R"(tangential_velocity_after [m/s],normal_impulse [N s],friction_impulse [N s],restitution,)"
            R"(law_friction,law_static_friction,law_restitution
1,0.125,floor,"the ""ball"", red",0,0,65536,stick,0,0,0,0,0,1,0,0,0,0,0,1,0.5,0,0.5,0.5,0
2,0.25,floor,"the ""ball"", red",0,0,65536,stick,0,0,0,0,0,1,0,0,0,0,0,1,0.5,0,0.5,0.5,0
)");
}

TEST(TrajectoryCsv, RowsDoNotDependOnHowManyAreAskedFor) {
  const Trajectory trajectory = ball_at_rest();
  EXPECT_EQ(samples_csv_rows(trajectory, 0, 3),
            samples_csv_rows(trajectory, 0, 1) + samples_csv_rows(trajectory, 1, 3));
  EXPECT_EQ(contacts_csv_rows(trajectory, 0, 2),
            contacts_csv_rows(trajectory, 0, 1) + contacts_csv_rows(trajectory, 1, 2));
}

TEST(WriteTrajectory, EveryFormat) {
  const tumble::test::TemporaryFolder folder;
  std::vector<std::string> endings = {"csv", "contacts.csv", "npz", "gif", "png", "svg", "Contacts.CSV"};
  if (has_hdf5()) endings.push_back("h5");
  for (const std::string& ending : endings) {
    write_trajectory(ball_at_rest(), folder / ("run." + ending));
    EXPECT_GT(std::filesystem::file_size(folder / ("run." + ending)), 400u) << ending;
  }
  EXPECT_EQ(folder.count_files(), endings.size()) << "no temporary file is left";
  EXPECT_EQ(read_file(folder / "run.contacts.csv", 10'000), read_file(folder / "run.Contacts.CSV", 10'000));
}

TEST(WriteTrajectory, RefusesWhatIsInconsistent) {
  const tumble::test::TemporaryFolder folder;
  const auto refusal = [&](auto change) {
    Trajectory trajectory = ball_at_rest();
    change(trajectory);
    return test::message_of<std::invalid_argument>([&] { write_trajectory(trajectory, folder / "run.npz"); });
  };
  using test::has;
  EXPECT_TRUE(has(refusal([](Trajectory& t) { t = {}; }), "must have one or more times"));
  EXPECT_TRUE(has(refusal([](Trajectory& t) { t.states.pop_back(); }), "got 3 times, 3 energies and 8 states"));
  EXPECT_TRUE(has(refusal([](Trajectory& t) { t.contacts[1].step = 1; }), "got 1 behind 1"));
  EXPECT_TRUE(has(refusal([](Trajectory& t) { t.contacts[1].step = 3; }), "steps in [1, 2]"));
  EXPECT_TRUE(
      has(refusal([](Trajectory& t) { t.contacts[0].contacts[0].contact.body_b = 3; }), "step 1 is of no body"));
  EXPECT_EQ(folder.count_files(), 0u);
}

}  // namespace
}  // namespace tumble::output

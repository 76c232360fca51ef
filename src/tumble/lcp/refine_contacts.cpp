#include "tumble/lcp/refine_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/QR>

namespace tumble {
namespace {

using Index = std::size_t;

// [-] of the largest speed at a contact before the impulses: velocities that miss by less are as good as sums over the
// contacts of some hundred bodies can be.
constexpr double k_round_off = 1e-13;

// Columns of M^-1/2 J^T that depend on others up to this count as dependent: masses may differ by 1e20, and contacts
// doubled up to 1e-12 are one.
constexpr double k_rank_tolerance = 1e-11;

constexpr int k_max_steps = 4;  // each gains the digits that the factors have, five and more where it works at all

// A sum in twice the digits of double [Ogita 2005].
struct LongSum {
  double high = 0.0;
  double low = 0.0;

  void add(double x) {
    const double sum = high + x;
    const double part = sum - high;
    low += (high - (sum - part)) + (x - part);
    high = sum;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(product);
    low += std::fma(a, b, -product);
  }
  double value() const { return high + low; }
};

class Refinement {
 public:
  Refinement(const ContactSystem& system, const std::vector<double>& z)
      : system_(system), count_(system.contacts.size()), f_(2 * count_), modes_(count_), u_(2 * count_) {
    for (Index i = 0; i < count_; ++i) {
      f_[2 * i].add(z[i]);
      f_[2 * i + 1].add(z[count_ + 2 * i] - z[count_ + 2 * i + 1]);
    }
    find_speed();
    find_velocities();
    for (Index i = 0; i < count_; ++i) {
      // The force of friction tells the direction of slip, where there is any.
      const double f_t = f_[2 * i + 1].value();
      modes_[i] = contact_mode(z[i], z[3 * count_ + i], f_t != 0.0 ? -f_t : u_[2 * i + 1]);
    }
    find_inertia();
  }

  // Largest velocity that contradicts the modes, relative to the speed before.
  double error() const {
    double error = 0.0;
    for (Index i = 0; i < count_; ++i) {
      const double u_n = u_[2 * i], u_t = u_[2 * i + 1];
      const bool is_open = modes_[i] == ContactMode::open;
      error = std::max(error, is_open ? -u_n : std::abs(u_n));
      if (modes_[i] == ContactMode::stick) error = std::max(error, std::abs(u_t));
      if (modes_[i] == ContactMode::slip_left) error = std::max(error, u_t);
      if (modes_[i] == ContactMode::slip_right) error = std::max(error, -u_t);
    }
    return speed_ > 0.0 ? error / speed_ : 0.0;
  }

  // One step. The error may grow in the first: huge impulses, rounded to double, leave a difference that moves light
  // bodies, which the next step finds.
  void improve() {
    correct();
    clamp();
    find_velocities();
  }

  RefinedContacts result() const {
    RefinedContacts result{std::vector<double>(4 * count_, 0.0), velocity_};
    for (Index i = 0; i < count_; ++i) {
      const double f_t = f_[2 * i + 1].value();
      result.z[i] = f_[2 * i].value();
      result.z[count_ + 2 * i + (f_t > 0.0 ? 0 : 1)] = std::abs(f_t);
      if (modes_[i] != ContactMode::stick) result.z[3 * count_ + i] = std::abs(u_[2 * i + 1]);
    }
    return result;
  }

 private:
  // Calls visit(body, normal row, tangent row) for the bodies of a contact that are not the world.
  template <class Visit>
  static void for_each_body(const BodyContact& c, const Visit& visit) {
    if (c.body_a >= 0) visit(static_cast<Index>(c.body_a), c.normal_a, c.tangent_a);
    if (c.body_b >= 0) visit(static_cast<Index>(c.body_b), c.normal_b, c.tangent_b);
  }

  void find_speed() {
    for (const BodyContact& c : system_.contacts) {
      const auto [u_n, u_t] = velocity_at(c, system_.velocity);
      speed_ = std::max({speed_, std::abs(u_n), std::abs(u_t)});
    }
  }

  // v + M^-1 J^T f: huge impulses of which only a small difference acts leave the digits of v alone.
  void find_velocities() {
    std::vector<std::array<LongSum, 3>> impulse(system_.velocity.size());
    for (Index i = 0; i < count_; ++i) {
      for_each_body(system_.contacts[i], [&](Index body, const Vector3& normal, const Vector3& tangent) {
        for (Index j = 0; j < 3; ++j) {
          for (const double part : {f_[2 * i].high, f_[2 * i].low}) impulse[body][j].add_product(normal[j], part);
          for (const double part : {f_[2 * i + 1].high, f_[2 * i + 1].low}) {
            impulse[body][j].add_product(tangent[j], part);
          }
        }
      });
    }
    velocity_ = system_.velocity;
    for (Index body = 0; body < velocity_.size(); ++body) {
      for (Index j = 0; j < 3; ++j) {
        velocity_[body][j] += system_.inverse_mass[body][j] * impulse[body][j].value();
      }
    }
    for (Index i = 0; i < count_; ++i) {
      const auto u = velocity_at(system_.contacts[i], velocity_);
      std::copy(u.begin(), u.end(), u_.begin() + static_cast<std::ptrdiff_t>(2 * i));
    }
  }

  // Square roots of the inverse masses over a reference, so that no unit of mass is under a root.
  void find_inertia() {
    for (const Index j : {Index{0}, Index{1}, Index{2}}) {
      for (const Vector3& w : system_.inverse_mass) reference_ = reference_ > 0.0 ? reference_ : w[j];
    }
    for (const Vector3& w : system_.inverse_mass) {
      for (const double x : w) roots_.push_back(reference_ > 0.0 ? std::sqrt(x / reference_) : 0.0);
    }
  }

  // (normal_share J_n + tangent_share J_t) M^-1/2 of a contact, as a column of length 1; its length before.
  double fill(Eigen::Ref<Eigen::VectorXd> column, const BodyContact& c, double normal_share,
              double tangent_share) const {
    column.setZero();
    for_each_body(c, [&](Index body, const Vector3& normal, const Vector3& tangent) {
      for (Index j = 0; j < 3; ++j) {
        const double entry = normal_share * normal[j] + tangent_share * tangent[j];
        column[static_cast<Eigen::Index>(3 * body + j)] += entry * roots_[3 * body + j];
      }
    });
    const double length = column.norm();
    if (length > 0.0) column /= length;
    return length > 0.0 ? length : 1.0;
  }

  // One Newton step. With E the rows of J that must not move and F those along which impulses act, both times M^-1/2,
  // find the impulses df with  E F^T df = -u,  not from this product but from E^T = Q R:  Q^T F^T df = -R^-T u.
  // Where contacts depend on each other, df is the shortest.
  void correct() {
    std::vector<Index> rows;  // 2 i, 2 i + 1
    for (Index i = 0; i < count_; ++i) {
      if (modes_[i] != ContactMode::open) rows.push_back(2 * i);
      if (modes_[i] == ContactMode::stick) rows.push_back(2 * i + 1);
    }
    if (rows.empty() || !(reference_ > 0.0)) return;
    const auto num_rows = static_cast<Eigen::Index>(rows.size());
    const auto num_velocities = static_cast<Eigen::Index>(roots_.size());
    Eigen::MatrixXd still(num_velocities, num_rows), acting(num_velocities, num_rows);
    Eigen::VectorXd u(num_rows), lengths(num_rows);
    for (Eigen::Index k = 0; k < num_rows; ++k) {
      const Index row = rows[static_cast<Index>(k)];
      const BodyContact& c = system_.contacts[row / 2];
      const double is_tangent = row % 2 == 0 ? 0.0 : 1.0;
      u[k] = u_[row] / fill(still.col(k), c, 1.0 - is_tangent, is_tangent);
      lengths[k] = fill(acting.col(k), c, 1.0 - is_tangent, is_tangent + friction_share(row));
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(num_velocities, num_rows);
    qr.setThreshold(k_rank_tolerance);
    qr.compute(still);
    const Eigen::Index rank = qr.rank();
    Eigen::VectorXd right = -(qr.colsPermutation().transpose() * u).head(rank);
    const Eigen::MatrixXd R = qr.matrixR().topLeftCorner(rank, rank);
    R.triangularView<Eigen::Upper>().transpose().solveInPlace(right);
    const Eigen::MatrixXd rotated = qr.householderQ().adjoint() * acting;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal(rank, num_rows);
    orthogonal.setThreshold(k_rank_tolerance);
    orthogonal.compute(rotated.topRows(rank));
    const Eigen::VectorXd df = orthogonal.solve(right);
    for (Eigen::Index k = 0; k < num_rows; ++k) {
      f_[rows[static_cast<Index>(k)]].add(df[k] / lengths[k] / reference_);
    }
  }

  // f_t / f_n of a contact that slips, in its normal row.
  double friction_share(Index row) const {
    if (row % 2 != 0) return 0.0;
    const BodyContact& c = system_.contacts[row / 2];
    const ContactMode mode = modes_[row / 2];
    return mode == ContactMode::slip_left ? c.friction : mode == ContactMode::slip_right ? -c.friction : 0.0;
  }

  // Back into the cones: full friction where it slips, no more than that where it sticks.
  void clamp() {
    for (Index i = 0; i < count_; ++i) {
      if (modes_[i] == ContactMode::open) continue;
      LongSum &f_n = f_[2 * i], &f_t = f_[2 * i + 1];
      if (!(f_n.value() >= 0.0)) f_n = {};
      const double limit = system_.contacts[i].friction * f_n.value();
      if (modes_[i] == ContactMode::stick) {
        if (std::abs(f_t.value()) > limit) f_t = {std::copysign(limit, f_t.value()), 0.0};
        continue;
      }
      f_t = {};
      for (const double part : {f_n.high, f_n.low}) f_t.add_product(friction_share(2 * i), part);
    }
  }

  const ContactSystem& system_;
  Index count_;
  std::vector<LongSum> f_;  // per contact (n, t)
  std::vector<ContactMode> modes_;
  std::vector<double> u_;          // per contact (n, t), after the impulses
  std::vector<Vector3> velocity_;  // per body, after the impulses
  double speed_ = 0.0;
  double reference_ = 0.0;     // some inverse mass > 0
  std::vector<double> roots_;  // of inverse masses / reference_
};

}  // namespace

RefinedContacts refine_contacts(const ContactSystem& system, const std::vector<double>& z, bool is_solved) {
  Refinement refinement(system, z);
  if (is_solved && refinement.error() <= k_round_off) return {};
  for (int step = 0; step < k_max_steps && refinement.error() > k_round_off; ++step) refinement.improve();
  return refinement.error() <= k_round_off ? refinement.result() : RefinedContacts{};
}

}  // namespace tumble

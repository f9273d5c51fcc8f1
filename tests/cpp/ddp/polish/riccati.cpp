#include "ddp/polish/riccati.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "ddp/support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

}  // namespace

TEST_CASE("the Newton step of a fixed sequence solves its dense KKT system") {
  std::uint64_t seed = 800;
  for (Model model : kModels)
    for (const mcplan::Scene& scene : scenes_of_all_kinds()) {
      constexpr int kSteps = 8;
      const Problem problem(scene, scenes::humanoid44(), phases(kSteps, model));
      Random random(++seed);
      CAPTURE(scene.name);
      CAPTURE(seed);
      const polish::FixedSequence fixed(problem, random_sequence(problem, random));
      const Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model);
      polish::Motion motion(fixed);
      motion.trajectory = shaken_guess(problem, random, 0.05);
      fixed.impose(motion.trajectory);
      REQUIRE(motion.evaluate(pendulum));
      polish::Riccati riccati(fixed);
      const int nx = fixed.nx(), pinned = nx - fixed.free_start();
      std::vector<int> first;
      int n = 0;
      for (int k = 0; k <= kSteps; ++k) {
        first.push_back(n);
        n += fixed.size(k);
      }
      // [H C'; C 0] [z; y] = [-g; -d]: dynamics, and the start that stays.
      const int rows = n + kSteps * nx + pinned;
      MatrixXd kkt = MatrixXd::Zero(rows, rows);
      VectorXd right = VectorXd::Zero(rows);
      for (int k = 0; k <= kSteps; ++k) {
        const int size = fixed.size(k);
        const MatrixXd root = noise(random, size, size, 1.0);
        riccati.model(k).h = root * root.transpose() + MatrixXd::Identity(size, size);
        riccati.model(k).g = noise(random, size, 1.0);
        kkt.block(first[k], first[k], size, size) = riccati.model(k).h;
        right.segment(first[k], size) = -riccati.model(k).g;
        if (k == kSteps) break;
        kkt.diagonal().segment(first[k] + nx, size - nx).array() += 0.3;  // the proximal weight
        const MatrixXd full = pendulum.dense_jacobian(motion.end(k));
        MatrixXd jacobian(nx, size);
        jacobian.leftCols(nx) = full.leftCols(nx);
        for (int i = 0; i < size - nx; ++i) jacobian.col(nx + i) = full.col(nx + fixed.phase(k).inputs[i]);
        kkt.block(n + k * nx, first[k], nx, size) = jacobian;
        kkt.block(n + k * nx, first[k + 1], nx, nx) = -MatrixXd::Identity(nx, nx);
        right.segment(n + k * nx, nx) = -motion.defect(k);
      }
      for (int i = 0; i < pinned; ++i) kkt(n + kSteps * nx + i, fixed.free_start() + i) = 1.0;
      kkt.topRightCorner(n, rows - n) = kkt.bottomLeftCorner(rows - n, n).transpose();
      const VectorXd dense = kkt.fullPivLu().solve(right);
      std::vector<VectorXd> dz(kSteps + 1);
      REQUIRE(riccati.solve(motion, 0.3, dz));
      for (int k = 0; k <= kSteps; ++k)
        CHECK((dz[k] - dense.segment(first[k], fixed.size(k))).norm() < 1e-7 * (1.0 + dense.head(n).norm()));
    }
}

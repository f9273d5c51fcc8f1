// Of IntervalMotion: the inputs of its graph at given parameters.
#include <cmath>

#include "base/cubic_spline.hpp"
#include "planar/sip/interval_motion.hpp"
#include "planar/sip/jet.hpp"

namespace mcplan::sip {

void IntervalMotion::set_splines(const Eigen::Ref<const Eigen::VectorXd>& x, bool derivatives) {
  const int controls = static_cast<int>(local.controls.size());
  const int durations = static_cast<int>(local.durations.size());
  const bool fixed_basis = graph.columns(splines_[0]).size() == local.controls.size();
  std::array<Jet, 5> spacing;
  for (int d = 0; d < 5; ++d)
    spacing[d] =
        Jet::variable(x[local.duration_column(local.knot_duration[d])], local.knot_duration[d], local.knot_ratio[d]);
  Eigen::Matrix4d basis = Eigen::Matrix4d::Zero();  // by distinct control point
  std::array<Eigen::Matrix4d, Jet::kSize> first;
  std::array<std::array<Eigen::Matrix4d, Jet::kSize>, Jet::kSize> second;
  if (derivatives && !fixed_basis) {
    for (int d = 0; d < durations; ++d) {
      first[d].setZero();
      for (int e = 0; e < durations; ++e) second[d][e].setZero();
    }
    const Eigen::Matrix<Jet, 4, 4> full = cubic_spline_basis(spacing);
    for (int i = 0; i < 4; ++i)
      for (int m = 0; m < 4; ++m) {
        const int c = local.control[i];
        basis(m, c) += full(m, i).value;
        for (int d = 0; d < durations; ++d) {
          first[d](m, c) += full(m, i).gradient[d];
          for (int e = 0; e < durations; ++e) second[d][e](m, c) += full(m, i).hessian(d, e);
        }
      }
  } else {
    std::array<double, 5> lengths{};
    for (int d = 0; d < 5; ++d) lengths[d] = fixed_basis ? 1.0 : spacing[d].value;
    const Eigen::Matrix4d full = cubic_spline_basis(lengths);
    for (int i = 0; i < 4; ++i) basis.col(local.control[i]) += full.col(i);
  }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    TaylorGraph::Input& input = graph.input_of(splines_[j]);
    const auto c = x.segment(local.control_column(static_cast<int>(j), 0), controls);
    input.coefficients.noalias() = basis.leftCols(controls) * c;
    if (!derivatives) continue;
    input.tangents.leftCols(controls) = basis.leftCols(controls);
    if (fixed_basis) continue;
    for (int d = 0; d < durations; ++d) {
      input.tangents.col(controls + d).noalias() = first[d].leftCols(controls) * c;
      for (int m = 0; m < 4; ++m) {
        Eigen::MatrixXd& curvature = input.curvature[m];
        curvature.col(controls + d).head(controls) = first[d].row(m).head(controls);
        curvature.row(controls + d).head(controls) = first[d].row(m).head(controls);
        for (int e = 0; e < durations; ++e)
          curvature(controls + d, controls + e) = second[d][e].row(m).head(controls).dot(c);
      }
    }
  }
}

void IntervalMotion::set_parameters(const Eigen::Ref<const Eigen::VectorXd>& x, bool derivatives) {
  set_splines(x, derivatives);
  const double duration = x[local.duration_column(local.own_duration)];
  for (const Power& power : powers_) {
    TaylorGraph::Input& input = graph.input_of(power.node);
    const int e = power.exponent;
    input.coefficients[0] = power.factor * std::pow(duration, e);
    input.tangents(0, 0) = power.factor * e * std::pow(duration, e - 1);
    input.curvature[0](0, 0) = power.factor * e * (e - 1) * std::pow(duration, e - 2);
  }
  for (std::size_t i = 0; i < force_inputs_.size(); ++i)
    graph.input_of(force_inputs_[i]).coefficients = x.segment<4>(local.force_column(4 * static_cast<int>(i)));
  if (gain_nodes_.empty()) return;
  ContactGain& gain = *gain_;
  gain.update(x.segment(local.weight_column(0), local.weights));
  for (std::size_t row = 0; row < gain_nodes_.size(); ++row)
    for (int i = 0; i < 3; ++i) {
      TaylorGraph::Input& input = graph.input_of(gain_nodes_[row][i]);
      const int r = static_cast<int>(row);
      input.coefficients[0] = gain.value()(r, i);
      for (int a = 0; derivatives && a < local.weights; ++a) {
        input.tangents(0, a) = gain.first(a)(r, i);
        for (int b = 0; b < local.weights; ++b) input.curvature[0](a, b) = gain.second(a, b)(r, i);
      }
    }
}

}  // namespace mcplan::sip

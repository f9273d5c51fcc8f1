#include "ddp/polish/base_course.hpp"

namespace mcplan::ddp::polish {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Hermite's cubics at s: that of the value and of the rate at the begin and at the end.
struct Hermite {
  double value_begin, rate_begin, value_end, rate_end;

  explicit Hermite(double s)
      : value_begin(1.0 - s * s * (3.0 - 2.0 * s)),
        rate_begin(s * (1.0 - s) * (1.0 - s)),
        value_end(s * s * (3.0 - 2.0 * s)),
        rate_end(s * s * (s - 1.0)) {}
};

}  // namespace

void BaseCourse::set(const Pendulum& pendulum, const Pendulum::Drive& begin, const PendulumStep& end) {
  const std::vector<int>& axes = pendulum.layout().axes();
  Vector3d momentum = Vector3d::Zero();
  end_angle_.setZero();
  for (std::size_t a = 0; a < axes.size(); ++a) {
    end_angle_[axes[a]] = end.angle[static_cast<int>(a)];
    momentum[axes[a]] = end.momentum[static_cast<int>(a)];
  }
  begin_angle_ = begin.angle;
  begin_ = pendulum.base_rate(begin.angle, begin.momentum);
  end_ = pendulum.base_rate(end_angle_, momentum);
  duration_ = end.duration;
}

Vector3d BaseCourse::at(double s) const {
  const Hermite h(s);
  return h.value_begin * begin_angle_ + h.value_end * end_angle_ +
         duration_ * (h.rate_begin * begin_.rate + h.rate_end * end_.rate);
}

BaseCourse::Derivatives BaseCourse::derivatives(double s) const {
  const Hermite h(s);
  const double of_begin = duration_ * h.rate_begin, of_end = duration_ * h.rate_end;
  Derivatives out;
  out.begin_angle = h.value_begin * Matrix3d::Identity() + of_begin * begin_.d_rpy;
  out.begin_momentum = of_begin * begin_.d_momentum;
  out.end.leftCols<3>() = h.value_end * Matrix3d::Identity() + of_end * end_.d_rpy;
  out.end.rightCols<3>() = of_end * end_.d_momentum;
  out.duration = h.rate_begin * begin_.rate + h.rate_end * end_.rate;
  return out;
}

}  // namespace mcplan::ddp::polish

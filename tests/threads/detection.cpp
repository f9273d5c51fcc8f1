// Does the thread sanitizer see what it should? `detection clean` shares data between threads as the library does;
// `detection omp` and `detection std` have a data race each, inside OpenMP and between threads of the standard library.
#include <cstdio>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

namespace {

constexpr int kThreads = 4, kNumbers = 1000;

double clean() {
  std::vector<double> squares(kNumbers);
  double sum = 0.0;
  for (int repeat = 0; repeat < 10; ++repeat) {
#pragma omp parallel for num_threads(kThreads) schedule(static) reduction(+ : sum)
    for (int i = 0; i < kNumbers; ++i) sum += squares[i] = i * i;
  }
  for (double square : squares) sum += square;
  std::mutex mutex;
  const auto add = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    sum += 1.0;
  };
  std::thread other(add);
  add();
  other.join();
  return sum;
}

double race_in_omp() {
  double sum = 0.0;
#pragma omp parallel for num_threads(kThreads) schedule(static)
  for (int i = 0; i < kNumbers; ++i) sum += i;
  return sum;
}

double race_in_std() {
  double sum = 0.0;
  const auto add = [&] { sum += 1.0; };
  std::thread other(add);
  add();
  other.join();
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const char* what = argc == 2 ? argv[1] : "";
  double sum = 0.0;
  if (std::strcmp(what, "clean") == 0)
    sum = clean();
  else if (std::strcmp(what, "omp") == 0)
    sum = race_in_omp();
  else if (std::strcmp(what, "std") == 0)
    sum = race_in_std();
  else
    return 2;
  std::printf("%g\n", sum);
  return 0;
}

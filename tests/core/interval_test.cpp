#include "core/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/affine.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

Interval random_interval(Random& random, double low, double high) {
    const double a = random.between(low, high), b = random.between(low, high);
    return {std::min(a, b), std::max(a, b)};
}

/// long double has 11 more bits: its own rounding stays far below one unit of double's last place.
bool holds(const Interval& x, long double exact) {
    return static_cast<long double>(x.low) <= exact && exact <= static_cast<long double>(x.high);
}

TEST(Interval, HoldsTheExactResultOfEveryOperation) {
    Random random(5);
    for (int i = 0; i < 20000; ++i) {
        // Thin ones too, where only the outward rounding saves the result.
        const double a = random.between(-9.0, 9.0), b = random.between(-9.0, 9.0);
        const Interval x{a, a}, y{b, b};
        const auto p = static_cast<long double>(a), q = static_cast<long double>(b);
        ASSERT_TRUE(holds(x + y, p + q)) << a << " " << b;
        ASSERT_TRUE(holds(x - y, p - q)) << a << " " << b;
        ASSERT_TRUE(holds(x * y, p * q)) << a << " " << b;
        ASSERT_TRUE(holds(square(x), p * p)) << a;
        if (b != 0.0) {
            ASSERT_TRUE(holds(x / y, p / q)) << a << " " << b;
        }
        if (a >= 0.0) {
            ASSERT_TRUE(holds(sqrt(x), std::sqrt(p))) << a;
        }
    }
}

TEST(Interval, HoldsTheResultsOfAllItsNumbers) {
    Random random(6);
    for (int i = 0; i < 5000; ++i) {
        const Interval x = random_interval(random, -3.0, 3.0);
        const Interval y = random_interval(random, -3.0, 3.0);
        for (int k = 0; k < 10; ++k) {
            const double a = random.between(x.low, x.high), b = random.between(y.low, y.high);
            ASSERT_TRUE((x + y).contains(a + b));
            ASSERT_TRUE((x - y).contains(a - b));
            ASSERT_TRUE((x * y).contains(a * b));
            ASSERT_TRUE((x / y).contains(a / b));
            ASSERT_TRUE(square(x).contains(a * a));
        }
    }
}

TEST(Interval, DividingByZeroSaysNothing) {
    const Interval all = Interval{1.0, 2.0} / Interval{-1.0, 1.0};
    EXPECT_TRUE(all.contains(1e300) && all.contains(-1e300));
    EXPECT_TRUE(intersection({0.0, 1.0}, {2.0, 3.0}).empty());
}

double square(double x) { return x * x; }

/// A chain of everything that affine forms can do, and the same in plain numbers.
template <class T, class Root, class Inverse, class Sin, class Cos>
T chain(const T& x, const T& y, Root root, Inverse inverse, Sin sin, Cos cos) {
    const T a = x * y + 2.0 * x - y + 0.25;
    const T b = root(T(square(a) + 1.0));
    const T c = inverse(T(b + square(y)));
    return c * a + sin(T(a)) * cos(T(b)) - square(c);
}

TEST(Affine, HoldsTheFunctionAndItsErrorFallsFourfold) {
    const AffineDomain whole;
    Random random(7);
    double error_before = 0.0;
    for (const double size : {0.06, 0.03, 0.015, 0.0075}) {
        double worst = 0.0;
        for (int i = 0; i < 300; ++i) {
            const double x0 = random.between(-1.5, 1.5), y0 = random.between(-1.5, 1.5);
            const Affine x{x0, size, 0.0, 0.0}, y{y0, 0.0, size, 0.0};
            const Affine form = chain(
                x, y, [&](const Affine& f) { return sqrt(f, range(f, whole)); },
                [&](const Affine& f) { return reciprocal(f, range(f, whole)); },
                [](const Affine& f) { return sine_of(f); },
                [](const Affine& f) { return cosine_of(f); });
            worst = std::max(worst, form.error);
            for (int k = 0; k < 20; ++k) {
                const double u = random.between(-1.0, 1.0), v = random.between(-1.0, 1.0);
                const double exact = chain(
                    x0 + size * u, y0 + size * v, [](double f) { return std::sqrt(f); },
                    [](double f) { return 1.0 / f; }, [](double f) { return std::sin(f); },
                    [](double f) { return std::cos(f); });
                ASSERT_LE(std::abs(exact - (form.center + form.du * u + form.dv * v)),
                          form.error + 1e-14)
                    << x0 << " " << y0;
            }
        }
        if (error_before > 0.0) {
            EXPECT_LT(worst, error_before / 3.0) << size;
        }
        error_before = worst;
    }
}

TEST(Affine, NarrowingKeepsWhatIsAllowed) {
    Random random(8);
    int narrowed = 0;
    for (int i = 0; i < 3000; ++i) {
        const Affine x{random.between(-1.0, 1.0), random.between(-1.0, 1.0),
                       random.between(-1.0, 1.0), random.between(0.0, 0.2)};
        const Interval allowed = random_interval(random, -2.0, 2.0);
        AffineDomain domain;
        const bool any = narrow(domain, x, allowed);
        narrowed += any && domain.share() < 0.99 ? 1 : 0;
        for (int k = 0; k < 30; ++k) {
            const double u = random.between(-1.0, 1.0), v = random.between(-1.0, 1.0);
            const double value = x.center + x.du * u + x.dv * v + random.between(-x.error, x.error);
            if (!allowed.contains(value)) continue;
            ASSERT_TRUE(any && domain.u.contains(u) && domain.v.contains(v));
        }
    }
    EXPECT_GT(narrowed, 300);
}

}  // namespace
}  // namespace ghostlight

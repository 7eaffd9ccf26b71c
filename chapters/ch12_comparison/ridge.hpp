/// @file
/// Linear regression with a penalty on large weights, by the normal equations: Hoerl & Kennard
/// 1970, "Ridge regression: biased estimation for nonorthogonal problems".
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace space {

/// intercept + sum of weights[j] x[j].
struct LinearModel {
    double intercept = 0.0;
    std::vector<double> weights = {};

    double operator()(std::span<const double> x) const {
        double y = intercept;
        for (std::size_t j = 0; j < weights.size(); ++j) y += weights[j] * x[j];
        return y;
    }
};

/// Solves A x = b for a symmetric A that is positive semidefinite, in rows, by its Cholesky factor.
/// A column that depends on those before it (but for rounding) gets no part in it: x is 0 there.
inline std::vector<double> solve_symmetric(std::vector<std::vector<double>> a,
                                           std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j) {
        const double diagonal = a[j][j];
        for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
        const bool depends = !(a[j][j] > 1e-10 * diagonal);
        a[j][j] = depends ? 0.0 : std::sqrt(a[j][j]);
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] = depends ? 0.0 : a[i][j] / a[j][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] = a[i][i] > 0.0 ? b[i] / a[i][i] : 0.0;
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
        b[i] = a[i][i] > 0.0 ? b[i] / a[i][i] : 0.0;
    }
    return b;
}

// [ridge]
/// The model with the least mean square error + the sum of penalties[j] times the square of
/// weights[j], in units of its column's standard deviation. A column of equal values gets the
/// weight 0. There must be a row, and all as long as the penalties.
inline LinearModel fit_ridge(std::span<const std::vector<double>> rows, std::span<const double> y,
                             std::span<const double> penalties) {
    const std::size_t columns = rows.front().size();
    const auto count = static_cast<double>(rows.size());
    double mean_y = 0.0;
    std::vector<double> mean(columns), deviation(columns);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        mean_y += y[i] / count;
        for (std::size_t j = 0; j < columns; ++j) mean[j] += rows[i][j] / count;
    }
    for (std::size_t j = 0; j < columns; ++j) {
        for (const auto& row : rows)
            deviation[j] += (row[j] - mean[j]) * (row[j] - mean[j]) / count;
        deviation[j] = std::sqrt(deviation[j]);
    }
    // The mean's own rounding is no spread.
    const auto standard = [&](const std::vector<double>& row, std::size_t j) {
        return deviation[j] > 1e-12 * std::abs(mean[j]) ? (row[j] - mean[j]) / deviation[j] : 0.0;
    };
    std::vector<std::vector<double>> a(columns, std::vector<double>(columns));
    std::vector<double> b(columns);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            const double z = standard(rows[i], j);
            b[j] += z * (y[i] - mean_y) / count;
            for (std::size_t k = 0; k < columns; ++k) a[j][k] += z * standard(rows[i], k) / count;
        }
    for (std::size_t j = 0; j < columns; ++j) a[j][j] += penalties[j];
    LinearModel model{mean_y, solve_symmetric(a, b)};
    for (std::size_t j = 0; j < columns; ++j) {
        if (model.weights[j] != 0.0) model.weights[j] /= deviation[j];
        model.intercept -= model.weights[j] * mean[j];
    }
    return model;
}
// [ridge]

// [smeared]
/// A model of log2 y foretells the middle of y. Moved, it foretells the mean, in which a cost that
/// is far off counts as it is paid: Duan 1983, "Smearing estimate: a nonparametric
/// retransformation method". Rows and log2 y are those that the model was fitted to.
inline LinearModel smeared(LinearModel model, std::span<const std::vector<double>> rows,
                           std::span<const double> log2_y) {
    double mean = 0.0;  // of y / what was foretold
    for (std::size_t i = 0; i < rows.size(); ++i)
        mean += std::exp2(log2_y[i] - model(rows[i])) / static_cast<double>(rows.size());
    model.intercept += std::log2(mean);
    return model;
}
// [smeared]

}  // namespace space

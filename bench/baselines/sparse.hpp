// Missing effects named by sparse regression of the base's residual on a library of terms of the motion.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron::baselines {

// A term of the library and the effects that such a force stands for: none where it is but the law in another dress,
// several where they are the same to first order.
struct Term {
  std::string_view text;
  std::vector<std::string_view> effects;
};
const std::vector<Term>& library();

struct Regression {
  Eigen::MatrixXd terms;    // samples x terms of the library; zero columns for terms that the recordings do not hold
  Eigen::VectorXd target;   // force that the fit lacks, over the norm of its recording
  std::size_t samples = 0;  // that count
};
// Of a fit on the fitted recordings, in the weights of its cost, every channel over its largest size in the campaign.
// Off the residual and off the terms is taken what the fit's own parameters do to first order, so that no term stands
// for these. `residuals`: those of the fit.
Regression regression_of(const Workbench& bench, const Fit& fit, const Residuals& residuals);

// Coefficients by sequentially thresholded least squares: terms of norm one whose coefficient is below the threshold
// are left out and the others fitted again, until none is. Source: Brunton, Proctor, Kutz, PNAS 113 (2016) 3932,
// doi 10.1073/pnas.1517384113.
Eigen::VectorXd thresholded(const Eigen::MatrixXd& terms, const Eigen::VectorXd& target, double threshold);

// Terms that stay, by their place in the library, with the threshold of several that the Bayesian information criterion
// prefers for so many independent values; empty where no term is worth its place.
// Source: Mangan, Kutz, Brunton, Proctor, Proceedings of the Royal Society A 473 (2017) 20170009.
std::vector<std::size_t> chosen_terms(const Regression& regression, double values);

}  // namespace hysteron::baselines

#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/certificate/certificate.h>

#include <string>

namespace dalembert {

/// Writes a run into an HDF5 file, a column for each number of a sample; docs/exports.md has the layout. The
/// columns are those of `write_csv`, of the same names and in the same order. Throws Error if the file cannot
/// be written, and for a name with '/', which HDF5 does not have in names.
template <int D>
void write_hdf5(const Trajectory<D>& run, const std::string& path);

/// The same with the estimated errors beside each quantity, as the functions of Certificate give them:
/// columns "bob.position.error", "bob.velocity.error", "wheel.angle.error", "wheel.rate.error",
/// "rod.lambda.error" (of vectors the norm); infinite where nothing is known.
template <int D>
void write_hdf5(const Certificate<D>& certificate, const std::string& path);

extern template void write_hdf5(const Trajectory<2>&, const std::string&);
extern template void write_hdf5(const Trajectory<3>&, const std::string&);
extern template void write_hdf5(const Certificate<2>&, const std::string&);
extern template void write_hdf5(const Certificate<3>&, const std::string&);

}  // namespace dalembert

#include "structure/equilibrium/tangent.h"

#include <cmath>

namespace magfsi::structure {

VolumetricStress volumetric_stress(const Material& material, double volume_ratio) {
    const double g = material.shear_modulus_pa;
    const double k = material.lame_lambda_pa;
    const double log_j = std::log(volume_ratio);
    return {(k * log_j - g) / volume_ratio,
            (k * (1 - log_j) + g) / (volume_ratio * volume_ratio)};
}

Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const VolumeDerivatives& volume,
                         const VolumetricStress& stress) {
    const Vector24 scaled = stress.modulus_pa / reference.volume * volume.gradient_m2;
    Matrix24 out = stress.pressure_pa * volume.hessian_m;
    out.noalias() += scaled * volume.gradient_m2.transpose();
    const Matrix8 springs = material.shear_modulus_pa * reference.spring_matrix;
    for (int b = 0; b < 8; ++b) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * b + d) += springs(a, b);
        }
    }
    return out;
}

Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const Positions8& x_m) {
    const Positions8 x = x_m.rowwise() - x_m.colwise().mean();
    const VolumeDerivatives volume = volume_derivatives(reference, x);
    Matrix24 out =
        element_tangent(reference, material, volume,
                        volumetric_stress(material, volume.volume_m3 / reference.volume));
    if (reference.variant == ElementVariant::assumed_strain) {
        out += hourglass_tangent(reference.hourglass, material, x);
    }
    return out;
}

}  // namespace magfsi::structure

// SPDX-License-Identifier: GPL-2.0-or-later
// pimpleFoam on a fixed mesh. The momentum and pressure equations are the solver's own
// files, included unchanged; the code here replaces its loop over time by one call per
// step.
#include <algorithm>
#include <cctype>
#include <memory>
#include <stdexcept>

#include "adapters/solvers/openfoam/engine/box_mesh.h"
#include "adapters/solvers/openfoam/engine/coupled_force.h"
#include "adapters/solvers/openfoam/engine/engine.h"
#include "adapters/solvers/openfoam/engine/functions.h"
#include "adapters/solvers/openfoam/engine/plane.h"
#include "dynamicCode.H"
#include "foamVersion.H"
#include "fvCFD.H"
#include "fvMatrices.H"
#include "fvOptions.H"
#include "fvcFlux.H"
#include "pimpleControl.H"
#include "singlePhaseTransportModel.H"
#include "turbulentTransportModel.H"

namespace magfsi::openfoam {

namespace {

static_assert(sizeof(Foam::vector) == 3 * sizeof(double), "vectors are three doubles");

// The field's memory as plain doubles, three a cell.
double* numbers(Foam::vectorField& field) {
    return reinterpret_cast<double*>(field.data());
}

std::vector<double> copy_of(const Foam::vectorField& field) {
    const auto* first = reinterpret_cast<const double*>(field.cdata());
    return {first, first + 3 * field.size()};
}

// Description of an initial field in the case's folder 0/, which must exist.
Foam::IOobject field_file(const char* name, const Foam::fvMesh& mesh) {
    return {name, mesh.time().timeName(), mesh, Foam::IOobject::MUST_READ,
            Foam::IOobject::NO_WRITE};
}

// OpenFOAM's messages have several lines; ours have one.
std::string one_line(std::string text) {
    while (!text.empty() && std::isspace(text.back()) != 0) text.pop_back();
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

// Runs `work` and turns Foam's FatalError and FatalIOError into std::runtime_error.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
    try {
        return work();
    } catch (const Foam::IOerror& e) {
        throw std::runtime_error("OpenFOAM: " + one_line(e.message()) + " (" +
                                 e.ioFileName() + ")");
    } catch (const Foam::error& e) {
        throw std::runtime_error("OpenFOAM: " + one_line(e.message()));
    }
}

// The case of this rank: a folder in that of all ranks where several write files.
Foam::fileName case_of_rank(const EngineSetup& setup) {
    const Foam::fileName whole = Foam::fileName(setup.case_folder).name();
    const bool files = setup.runs_functions || setup.writes_fields;
    if (!files || setup.mesh.first_cell.size() <= 2) return whole;
    return whole / ("processor" + std::to_string(setup.mesh.rank));
}

// The engine on one rank. Members are initialised in the order that OpenFOAM requires:
// time, mesh, fields, models.
class PimpleEngine final : public Engine {
  public:
    explicit PimpleEngine(const EngineSetup& setup)
        : time_(Foam::Time::controlDictName, Foam::fileName(setup.case_folder).path(),
                case_of_rank(setup), "system", "constant", false, false),
          mesh_(setup.reads_mesh ? read_mesh(time_) : make_mesh(time_, setup.mesh)),
          box_(setup.mesh),
          reads_mesh_(setup.reads_mesh),
          balances_force_(setup.balances_force),
          places_(setup.reads_mesh ? std::vector<FacePlace>() : face_places(setup.mesh)),
          pimple_(mesh_()),
          p_(field_file("p", mesh_()), mesh_()),
          u_(field_file("U", mesh_()), mesh_()),
          phi_(Foam::IOobject("phi", time_.timeName(), mesh_()), Foam::fvc::flux(u_)),
          transport_(u_, phi_),
          turbulence_(Foam::incompressible::turbulenceModel::New(u_, phi_, transport_)),
          zones_(mesh_()),
          sources_(Foam::fv::options::New(mesh_())) {
        Foam::setRefCell(p_, pimple_.dict(), reference_cell_, reference_pressure_);
        mesh_->setFluxRequired(p_.name());
        turbulence_->validate();
        if (setup.writes_fields) begin_writing();
        if (setup.runs_functions) functions_.make(time_);
    }

    // The internal field holds three doubles a cell (static_assert above).
    const double* velocity() const override {
        return reinterpret_cast<const double*>(u_.primitiveField().cdata());
    }
    // OpenFOAM's list of sources takes ownership of the force.
    double* acceleration() override {
        if (force_ == nullptr) {
            force_ =
                balances_force_ ? new BalancedForce(mesh_()) : new CoupledForce(mesh_());
            static_cast<Foam::fv::optionList&>(sources_).append(force_);
        }
        return numbers(force_->acceleration());
    }

    double* side_velocity(int side) override {
        const auto name = side_names[side];
        const Foam::label patch = mesh_->boundaryMesh().findPatchID(name);
        if (patch < 0) return nullptr;  // an obstacle covers the side
        auto& values = u_.boundaryFieldRef()[patch];
        return values.fixesValue() && values.size() > 0 ? numbers(values) : nullptr;
    }

    ReadCells cells() const override {
        ReadCells all;
        const Foam::scalarField& volumes = mesh_->V();
        all.volume_m3.assign(volumes.begin(), volumes.end());
        for (const Foam::point& p : mesh_->cellCentres())
            all.centre_m.push_back({p[0], p[1], p[2]});
        return all;
    }

    std::vector<int> find(const std::vector<std::array<double, 3>>& points_m) override {
        return guarded([&] {
            std::vector<int> found;
            for (const auto& p : points_m)
                found.push_back(mesh_->findCell(Foam::point(p[0], p[1], p[2])));
            return found;
        });
    }

    std::vector<std::array<double, 3>> side_faces(int side) const override {
        const Foam::label patch = mesh_->boundaryMesh().findPatchID(side_names[side]);
        std::vector<std::array<double, 3>> centres;
        for (const Foam::point& p : mesh_->boundary()[patch].Cf())
            centres.push_back({p[0], p[1], p[2]});
        return centres;
    }

    // The sign is that of OpenFOAM's `forces`: area vectors point out of the fluid, into
    // the body.
    std::array<double, 3> force_on(const std::string& patch) override {
        return guarded([&] {
            Foam::vector force(Foam::Zero);
            const Foam::label p = mesh_->boundaryMesh().findPatchID(patch);
            if (p >= 0) {  // absent where the mesh left nothing of it
                const Foam::vectorField& area = mesh_->boundary()[p].Sf();
                const Foam::tmp<Foam::volSymmTensorField> stress = turbulence_->devReff();
                force = Foam::sum(p_.boundaryField()[p] * area) +
                        Foam::sum(area & stress().boundaryField()[p]);
            }
            Foam::reduce(force, Foam::sumOp<Foam::vector>());
            return std::array<double, 3>{force[0], force[1], force[2]};
        });
    }

    // Fluxes are interpolated from the cells; the next pressure correction makes them
    // free of divergence.
    void set_velocity(const double* velocity) override {
        guarded([&] {
            auto& values = u_.primitiveFieldRef();
            std::copy_n(velocity, 3 * values.size(), numbers(values));
            u_.correctBoundaryConditions();
            phi_ = Foam::fvc::flux(u_);
        });
    }

    void advance(bool may_repeat) override {
        guarded([&] { step(may_repeat); });
    }
    bool can_answer_again() const override { return equation_.valid(); }
    void answer_again() override {
        guarded([&] { answer(); });
    }

    // oldTime() is the velocity one step ago, which the backward scheme needs.
    void keep(FlowState& state) const override {
        guarded([&] {
            state.velocity = copy_of(u_.primitiveField());
            state.old_velocity = copy_of(u_.oldTime().primitiveField());
            const Foam::scalarField& p = p_.primitiveField();
            state.pressure.assign(p.cdata(), p.cdata() + p.size());
            if (reads_mesh_)
                take_face_flux(phi_, state.face_flux);
            else
                take_flux(phi_, places_, state);
        });
    }

    // Fluxes are restored first, since the velocity at outlets depends on them. The
    // velocity of two steps ago is discarded when the step begins, and the old fluxes
    // have the coefficient 0 in the scheme; calls of oldTime() only make sure that these
    // fields exist.
    void go_back(const FlowState& state, long step) override {
        guarded([&] {
            const auto index = static_cast<Foam::label>(step);
            time_.setTime(1.0 * step * time_.deltaTValue(), index);
            phi_.timeIndex() = u_.timeIndex() = index;
            if (reads_mesh_)
                put_face_flux(state.face_flux, phi_);
            else
                put_flux(state, places_, phi_);
            Foam::vectorField& u = u_.primitiveFieldRef();
            std::copy(state.velocity.begin(), state.velocity.end(), numbers(u));
            u_.correctBoundaryConditions();
            Foam::vectorField& before = u_.oldTime().primitiveFieldRef();
            std::copy(state.old_velocity.begin(), state.old_velocity.end(),
                      numbers(before));
            u_.oldTime().oldTime();
            phi_.oldTime().oldTime();
            Foam::scalarField& p = p_.primitiveFieldRef();
            std::copy(state.pressure.begin(), state.pressure.end(), p.begin());
            p_.correctBoundaryConditions();
        });
    }

    // The curl comes from gradients of OpenFOAM's scheme gradSchemes (Gauss linear).
    void vorticity(double* out) override {
        guarded([&] {
            const Foam::tmp<Foam::volVectorField> curl = Foam::fvc::curl(u_);
            const Foam::vectorField& values = curl().primitiveField();
            std::copy_n(reinterpret_cast<const double*>(values.cdata()),
                        3 * values.size(), out);
        });
    }

    PlaneSums plane(int axis, double at_m) override {
        return guarded([&] {
            const double length = box_.planes_m[static_cast<std::size_t>(axis)].back();
            return plane_sums(u_, p_, phi_, axis, at_m, length);
        });
    }

    // The end is moved to the present time for function objects that run at the end, for
    // a run may be stopped before its own.
    void record(bool last) override {
        guarded([&] {
            if (writes_ && (last || time_.writeTime())) time_.writeNow();
            if (last) time_.setEndTime(time_.value());
            functions_.run(last);
        });
    }

    std::string version() const override {
        return std::to_string(Foam::foamVersion::api);
    }

  private:
    void step(bool may_repeat);
    void answer();
    void correct_pressure(Foam::tmp<Foam::fvVectorMatrix>& tUEqn);

    // Writes the mesh, once, and marks the fields that time folders have.
    void begin_writing() {
        mesh_->setInstance(time_.constant());  // marks all its files to be written
        if (!reads_mesh_) mesh_->write();
        mesh_->setInstance(time_.constant(), Foam::IOobject::NO_WRITE);
        p_.writeOpt() = u_.writeOpt() = phi_.writeOpt() = Foam::IOobject::AUTO_WRITE;
        writes_ = true;
    }

    Foam::Time time_;
    Foam::autoPtr<Foam::fvMesh> mesh_;
    BoxMesh box_;
    bool reads_mesh_, balances_force_;
    std::vector<FacePlace> places_;  // empty on a mesh that was read
    Foam::pimpleControl pimple_;
    Foam::volScalarField p_;
    Foam::volVectorField u_;
    Foam::surfaceScalarField phi_;
    Foam::singlePhaseTransportModel transport_;
    Foam::autoPtr<Foam::incompressible::turbulenceModel> turbulence_;
    Foam::IOMRFZoneList zones_;
    Foam::fv::options& sources_;
    // The coupling force, owned by sources_; null until the first force.
    CoupledForce* force_ = nullptr;
    // The momentum equation of the last step, if the step may be repeated.
    Foam::tmp<Foam::fvVectorMatrix> equation_;
    Foam::label reference_cell_ = 0;
    Foam::scalar reference_pressure_ = 0;
    Foam::scalar continuity_error_ = 0;
    bool writes_ = false;  // time folders
    Functions functions_;  // refer to the members above
};

// One step of pimpleFoam. The local names are those that the included solver files use.
void PimpleEngine::step(bool may_repeat) {
    using namespace Foam;
    pimpleControl& pimple = pimple_;
    volScalarField& p = p_;
    volVectorField& U = u_;
    surfaceScalarField& phi = phi_;
    auto& turbulence = turbulence_;
    IOMRFZoneList& MRF = zones_;
    fv::options& fvOptions = sources_;

    equation_.clear();
    ++time_;
    while (pimple.loop()) {
#include "UEqn.H"
        correct_pressure(tUEqn);
        // With a single correction the solver's files have dropped the equation.
        if (may_repeat && tUEqn.valid()) equation_ = tUEqn;
        if (pimple.turbCorr()) {
            transport_.correct();
            turbulence->correct();
        }
    }
}

// The corrections of PISO: the pressure that makes the velocity of the momentum equation
// free of divergence.
void PimpleEngine::correct_pressure(Foam::tmp<Foam::fvVectorMatrix>& tUEqn) {
    using namespace Foam;
    fvMesh& mesh = mesh_();
    Time& runTime = time_;
    pimpleControl& pimple = pimple_;
    volScalarField& p = p_;
    volVectorField& U = u_;
    surfaceScalarField& phi = phi_;
    IOMRFZoneList& MRF = zones_;
    fv::options& fvOptions = sources_;
    const label pRefCell = reference_cell_;
    const scalar pRefValue = reference_pressure_;
    scalar& cumulativeContErr = continuity_error_;
    autoPtr<surfaceVectorField> Uf;  // used with moving meshes only
    fvVectorMatrix& UEqn = tUEqn.ref();

    while (pimple.correct()) {
#include "pEqn.H"
    }
}

// More corrections of PISO, with the present force in the momentum equation of the step:
// the force is found together with the pressure (PISO-IB: Blais et al., Int. J. Numer.
// Meth. Fluids 80 (2016) 513), for a fraction of what a step costs.
void PimpleEngine::answer() {
    if (force_ != nullptr) force_->renew(equation_.ref());
    correct_pressure(equation_);
}

}  // namespace

}  // namespace magfsi::openfoam

// Errors of OpenFOAM become exceptions in place of an exit, and its log is switched off.
// Pstream starts only for more than one rank, and only once.
magfsi::openfoam::Engine* magfsi_openfoam_engine(
    const magfsi::openfoam::EngineSetup& setup) {
    using namespace magfsi::openfoam;
    Foam::FatalError.throwExceptions();
    Foam::FatalIOError.throwExceptions();
    Foam::messageStream::level = 0;  // no log of every linear solve
    // A scene may come from a stranger: its dictionaries compile and run nothing.
    Foam::dynamicCode::allowSystemOperations = 0;
    if (setup.mesh.first_cell.size() > 2 && !Foam::UPstream::parRun()) {
        int arguments = 0;
        char** none = nullptr;
        Foam::UPstream::init(arguments, none, false);
    }
    return guarded([&] { return new PimpleEngine(setup); });
}

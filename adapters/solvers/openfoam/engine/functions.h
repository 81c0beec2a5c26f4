// SPDX-License-Identifier: GPL-2.0-or-later
// The function objects of a case. OpenFOAM's own list of them (functionObjectList) ends
// the process or passes over an object that cannot be made; here its error is thrown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "Time.H"
#include "functionObject.H"
#include "timeControlFunctionObject.H"

namespace magfsi::openfoam {

// Libraries are looked for by the loader. A folder in a name could be anywhere, also
// where the writer of a scene has put a library of his own.
inline void refuse_paths(const Foam::dictionary& dict) {
    for (const char* key : {"libs", "functionObjectLibs"}) {
        if (!dict.found(key)) continue;
        for (const Foam::fileName& library : dict.get<Foam::fileNameList>(key)) {
            if (library.find('/') == std::string::npos) continue;
            FatalErrorInFunction << "the library " << library << " in " << dict.name()
                                 << " has a folder in its name"
                                 << Foam::exit(Foam::FatalError);
        }
    }
    for (const Foam::entry& item : dict)
        if (item.isDict()) refuse_paths(item.dict());
}

class Functions {
  public:
    // Makes the objects of controlDict's functions {}. Mesh and fields must be there.
    // Collective.
    void make(Foam::Time& time) {
        const Foam::dictionary* all = time.controlDict().findDict("functions");
        if (all == nullptr) return;
        refuse_paths(*all);
        time.libs().open(*all, "libs",
                         Foam::functionObject::dictionaryConstructorTablePtr_);
        for (const Foam::entry& item : *all) {
            if (!item.isDict() || !item.dict().lookupOrDefault("enabled", true)) continue;
            made_.push_back(one(item.keyword(), time, item.dict()));
        }
    }

    // Runs the objects after a step; `last`: and ends them. Collective.
    void run(bool last) {
        for (const auto& object : made_) {
            object->execute();
            object->write();
            if (last) object->end();
        }
    }

  private:
    static std::unique_ptr<Foam::functionObject> one(const Foam::word& name,
                                                     const Foam::Time& time,
                                                     const Foam::dictionary& dict) {
        using Control = Foam::functionObjects::timeControl;
        if (Control::entriesPresent(dict))
            return std::make_unique<Control>(name, time, dict);
        return std::unique_ptr<Foam::functionObject>(
            Foam::functionObject::New(name, time, dict).ptr());
    }

    std::vector<std::unique_ptr<Foam::functionObject>> made_;
};

}  // namespace magfsi::openfoam

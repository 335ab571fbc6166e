#!/usr/bin/env bash
# Runs the tests behind docs/results: the three models, the penalty ten times smaller and larger, and
# a continuum as stiff as the grains.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
prm=drivers/two_scale_triaxial/two_scale_triaxial.prm
./run two_scale_triaxial $prm --output results/grains --set "Model/kind=grains"
./run two_scale_triaxial $prm --output results/continuum --set "Model/kind=continuum"
./run two_scale_triaxial $prm --output results/penalty-1e13 --set "Coupling/penalty=1e13" --no-plots
./run two_scale_triaxial $prm --output results/penalty-1e15 --set "Coupling/penalty=1e15" --no-plots
./run two_scale_triaxial $prm --output results/continuum-stiff --no-plots --set "Model/kind=continuum" \
  --set "Continuum/Young's modulus=5e8"
./run two_scale_triaxial $prm --output results/two-scale-stiff --no-plots --set "Continuum/Young's modulus=5e8" \
  --set "Coupling/penalty=1e15" --set "Loading/time step=1e-7"
./run two_scale_triaxial $prm --output results/two_scale_triaxial # last: draws the comparison

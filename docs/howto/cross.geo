// A cross of four arms, one layer of hexahedra: 6 mm long, 1 mm wide, 0.2 mm thick. Lengths in mm.
//   gmsh -3 -format msh41 cross.geo
arm = 2.5; half = 0.5; thick = 0.2;
along = 8; across = 4;  // elements of an arm
Point(1) = {-half, -half, 0}; Point(2) = {half, -half, 0};
Point(3) = {half, half, 0};   Point(4) = {-half, half, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = across + 1; Transfinite Surface {1}; Recombine Surface {1};
hub[] = Extrude {0, 0, thick} { Surface{1}; Layers{1}; Recombine; };
east[] = Extrude {arm, 0, 0} { Surface{hub[3]}; Layers{along}; Recombine; };
north[] = Extrude {0, arm, 0} { Surface{hub[4]}; Layers{along}; Recombine; };
west[] = Extrude {-arm, 0, 0} { Surface{hub[5]}; Layers{along}; Recombine; };
south[] = Extrude {0, -arm, 0} { Surface{hub[2]}; Layers{along}; Recombine; };
Physical Volume("hub") = {hub[1]};
Physical Volume("east") = {east[1]};   Physical Volume("west") = {west[1]};
Physical Volume("north") = {north[1]}; Physical Volume("south") = {south[1]};
Physical Surface("bottom") = {1};      // the hub's lower face, to be clamped

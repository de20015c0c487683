// The dovetail of a blade in the slot of its disk; one half, x = 0 is the plane of symmetry, and one half of the thickness. Lengths in mm.
//   gmsh -3 dovetail.geo -o dovetail.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 2.4 ];
Mesh.MeshSizeMin = 0.3*h; Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromCurvature = 10;
DefineConstant[ w = 6 ];        // half of the thickness
g = 0.1;                        // gap at the foot and at the neck
// the root: a neck of half width 4, flanks of 45 degrees from y = -3 to -8
Point(1) = {0,-10,0}; Point(2) = {9,-10,0}; Point(3) = {9,-7,0}; Point(4) = {4,-2,0}; Point(5) = {4,8,0}; Point(6) = {0,8,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5}; Line(5) = {5,6}; Line(6) = {6,1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
v() = Extrude {0,0,w} { Surface{1}; };
// the slot, which touches the flank alone
Point(21) = {0,-10-g,0}; Point(22) = {9+g,-10-g,0}; Point(23) = {9+g,-7-g,0}; Point(24) = {4+g,-2-g,0}; Point(25) = {4+g,0,0};
Point(26) = {20,0,0}; Point(27) = {20,-20,0}; Point(28) = {0,-20,0};
For k In {21:27}
  Line(k) = {k,k+1};
EndFor
Line(28) = {28,21};
Curve Loop(20) = {21:28}; Plane Surface(20) = {20};
u() = Extrude {0,0,w} { Surface{20}; };
// the root's fillet under its neck, and the round edge of the slot
a() = Fillet{ 1 }{ 12 }{ 1 };
b() = Fillet{ 2 }{ 34 }{ 1.5 };
Physical Volume("root") = {a(0)};
Physical Volume("disk") = {b(0)};
e = 0.01;
Physical Surface("blade") = Surface In BoundingBox {-e,8-e,-e, 5,8+e,w+e};
Physical Surface("floor") = Surface In BoundingBox {-e,-20-e,-e, 21,-20+e,w+e};
Physical Surface("side") = Surface In BoundingBox {20-e,-21,-e, 20+e,e,w+e};
Physical Surface("plane x") = Surface In BoundingBox {-e,-21,-e, e,9,w+e};
Physical Surface("plane z") = Surface In BoundingBox {-e,-21,-e, 21,9,e};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("flank of the root") = {30, 32};
Physical Surface("flank of the slot") = {39, 41};

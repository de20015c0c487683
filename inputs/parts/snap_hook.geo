// A snap hook of plastic goes past a catch and springs back behind it; one half, z = 0 is the plane of symmetry. Lengths in mm.
//   gmsh -3 snap_hook.geo -o snap_hook.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 1.35 ];
DefineConstant[ w = 2.5 ];     // half of the width
Mesh.MeshSizeMin = 0.3*h; Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromCurvature = 12;
// the hook: an arm from x = -20 to 4, y from 0 to 2, and a nose up to y = 3.6
Point(1) = {-20,0,0}; Point(2) = {5,0,0}; Point(3) = {5,0.8,0}; Point(4) = {1.6,3.2,0};
Point(5) = {0.4,3.2,0}; Point(6) = {-1.1,2,0}; Point(7) = {-20,2,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5}; Line(5) = {5,6}; Line(6) = {6,7}; Line(7) = {7,1};
Curve Loop(1) = {1:7}; Plane Surface(1) = {1};
v() = Extrude {0,0,w} { Surface{1}; };
f() = Fillet{ 1 }{ 13, 15 }{ 0.8 };
// the catch, whose two lower edges are round
Box(11) = {2.6,2.2,0, 2.6,3,3.5};
q() = Fillet{ 11 }{ 28, 32 }{ 0.8 };
Field[1] = Box; Field[1].XMin = -2; Field[1].XMax = 5.5; Field[1].YMin = 1.9; Field[1].YMax = 3.6; Field[1].ZMin = -1; Field[1].ZMax = 4;
Field[1].VIn = 0.45*h; Field[1].VOut = h; Field[1].Thickness = 1;
Background Field = 1;
Physical Volume("hook") = {f(0)};
Physical Volume("catch") = {q(0)};
e = 0.01;
Physical Surface("base") = Surface In BoundingBox {-20-e,-e,-e, -20+e,2+e,w+e};
Physical Surface("top") = Surface In BoundingBox {2,5.2-e,-e, 6,5.2+e,4};
Physical Surface("plane z") = Surface In BoundingBox {-21,-e,-e, 6,6,e};
// What follows names surfaces that touch, for CalculiX alone: Mortise finds them.
Physical Surface("nose") = {1, 3, 6, 8, 10, 11};
Physical Surface("edge of the catch") = {12, 14, 17, 18, 19};

// A piston with an O-ring in its groove goes into a bore with a chamfer; axisymmetric, x is the radius. Lengths in mm.
//   gmsh -2 o_ring.geo -o o_ring.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 0.2 ];
Mesh.MeshSizeMin = h/3; Mesh.MeshSizeMax = 3*h;
Mesh.MeshSizeFromCurvature = 0;
R = 20; d = 3.5;               // bore, cord
// the piston: its groove is 2.9 deep and 4.6 wide, with its floor at R - 3.0
Point(1) = {10,-5,0}; Point(2) = {R-0.1,-5,0}; Point(3) = {R-0.1,-2.3,0,h}; Point(4) = {R-3.0,-2.3,0,h};
Point(5) = {R-3.0,2.3,0,h}; Point(6) = {R-0.1,2.3,0,h}; Point(7) = {R-0.1,5,0}; Point(8) = {10,5,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5}; Line(5) = {5,6}; Line(6) = {6,7}; Line(7) = {7,8}; Line(8) = {8,1};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1};
// the ring, which touches the floor of the groove
Disk(2) = {R-3.0+d/2, 0, 0, d/2};
// the housing: a chamfer of 15 degrees, its edge rounded by 1; the chamfer faces the ring, the housing moves up
c = 15*Pi/180; y0 = 2.8; l = 5;
Point(21) = {R,y0-12,0}; Point(22) = {R,y0-l,0,h}; Point(23) = {R+l*Tan(c),y0,0,h}; Point(24) = {R+6,y0,0}; Point(25) = {R+6,y0-12,0};
Line(21) = {21,22}; Line(22) = {22,23}; Line(23) = {23,24}; Line(24) = {24,25}; Line(25) = {25,21};
Curve Loop(3) = {21:25}; Plane Surface(3) = {3};
Field[1] = Distance; Field[1].CurvesList = {2,3,4,5,21,22, 9}; Field[1].NumPointsPerCurve = 200;
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = h; Field[2].SizeMax = 3*h; Field[2].DistMin = 0.2; Field[2].DistMax = 3;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Physical Surface("piston") = {1};
Physical Surface("ring") = {2};
Physical Surface("housing") = {3};
e = 0.01;
Physical Curve("back of the piston") = {8};
Physical Curve("back of the housing") = {24};
Physical Curve("groove") = {3,4,5};
Physical Curve("cord") = {9};
Physical Curve("bore") = {21,22};

#pragma once
#include "erkp.h"
template<class G> Scene make(std::string name,double T,double length,double time,V<double> q,V<double> v,G g){ Scene s; s.name=name;s.n=(int)q.size();s.T=T;s.length=length;s.time=time;s.q0=q;s.v0=v; s.f=[g](double t,const double*a,const double*b,double*c){g(t,a,b,c);}; s.F=[g](ld t,const ld*a,const ld*b,ld*c){g(t,a,b,c);}; return s; }
inline std::vector<Scene> scenes(){ std::vector<Scene> all;
 all.push_back(make("fall",1.1107,1,0.7,{1,0},{0,0},[](auto,auto*q,auto*,auto*a){auto r2=q[0]*q[0]+q[1]*q[1]; auto r3=r2*std::sqrt(r2); a[0]=-q[0]/r3;a[1]=-q[1]/r3;}));
 all.push_back(make("kepler99",6.2832,1,1.0,{1.99,0},{0,std::sqrt(0.01/1.99)},[](auto,auto*q,auto*,auto*a){auto r2=q[0]*q[0]+q[1]*q[1]; auto r3=r2*std::sqrt(r2); a[0]=-q[0]/r3;a[1]=-q[1]/r3;}));
 for(double b : {0.3,0.03,0.003,0.0}) all.push_back(make("spring"+std::to_string(b),5,1,0.3,{1.0,b},{-1.0,0.0},[b](auto,auto*q,auto*,auto*a){ auto l=std::sqrt(q[0]*q[0]+q[1]*q[1]); auto k=10*(1-0.5/l); a[0]=-k*q[0]; a[1]=-k*q[1]-(b==0?0:1)*0.0;}));
 all.push_back(make("drivenspring",5,1,0.3,{0.7,0.1},{0,0.0},[](auto t,auto*q,auto*,auto*a){ auto x=q[0]-0.3*std::sin(2*t),y=q[1]-0.05*std::cos(3*t); auto l=std::sqrt(x*x+y*y); auto k=10*(1-0.5/l); a[0]=-k*x; a[1]=-k*y;}));
 all.push_back(make("pendulum",10,1,0.32,{1,0},{0,0},[](auto,auto*q,auto*v,auto*a){ auto r2=q[0]*q[0]+q[1]*q[1]; auto l=(v[0]*v[0]+v[1]*v[1]-(decltype(r2))9.81*q[1])/r2; a[0]=-l*q[0]; a[1]=-l*q[1]-(decltype(r2))9.81;}));
 // chain of 6 beads: x_i, distances, accelerations by dense solve
 { const int N=6; V<double> q(2*N),v(2*N,0); for(int i=0;i<N;++i){ double c=1.0/N*(i+1); q[2*i]=c*0.8; q[2*i+1]=c*0.6*0+ -c*0.6;} 
  all.push_back(make("chain6",3,1,0.32,q,v,[N](auto,auto*q,auto*v,auto*a){ using R=std::decay_t<decltype(*q)>; typedef Eigen::Matrix<R,Eigen::Dynamic,1> X; typedef Eigen::Matrix<R,Eigen::Dynamic,Eigen::Dynamic> M; M J=M::Zero(N,2*N); X g(N); for(int i=0;i<N;++i){ for(int c=0;c<2;++c){ R d=q[2*i+c]-(i?q[2*i-2+c]:R(0)); J(i,2*i+c)=d; if(i)J(i,2*i-2+c)=-d;} R s=0; for(int c=0;c<2;++c){R u=v[2*i+c]-(i?v[2*i-2+c]:R(0)); s+=u*u;} g(i)=-s; } X F=X::Zero(2*N); for(int i=0;i<N;++i)F(2*i+1)=R(-9.81); M S=J*J.transpose(); X lam=S.ldlt().solve(g-J*F); X A=F+J.transpose()*lam; for(int i=0;i<2*N;++i)a[i]=A(i); })); }
 // double pendulum like fast: van der Pol-ish smooth: Henon-Heiles
 all.push_back(make("henon",50,0.5,1,{0.1,0.2},{0.5,0.1},[](auto,auto*q,auto*,auto*a){ a[0]=-q[0]-2*q[0]*q[1]; a[1]=-q[1]-q[0]*q[0]+q[1]*q[1];}));
 // softened: 1/(x^2+eps^2) close pole passes
 all.push_back(make("runge",4,1,1,{-2,0},{1,0},[](auto t,auto*q,auto*,auto*a){ auto x=q[0]; (void)t; a[0]=0*x; a[1]=1/(1+(decltype(x))25*x*x);}));
 return all; }
